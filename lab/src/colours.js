/* colours.js - what both views paint alike. */
export const NORTH = "#d43d3d", SOUTH = "#3b6fd4";
export const ARROWS = { moment: "#f2c230", field: "#7fd0ff", friction: "#ff8a5c", load: "#9be08a" };
/* Lengths of arrows, in bead radii for one weight of the bead.  The magnet pulls the bead down with some twenty. */
export const FRICTION = 1.2, LOAD = 0.12;
