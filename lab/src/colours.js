/* colours.js - what both views paint alike. */
export const NORTH = "#d43d3d", SOUTH = "#3b6fd4";
export const ARROWS = { moment: "#f2c230", field: "#7fd0ff", friction: "#ff8a5c", load: "#9be08a" };
