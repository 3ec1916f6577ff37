/* colours.js - what both views paint alike. */
/* Behind all, on the screen and on paper. */
export const GROUND = { screen: "#141a22", paper: "#ffffff" };
export const NORTH = "#d43d3d", SOUTH = "#3b6fd4";
export const ARROWS = { moment: "#f2c230", field: "#7fd0ff", friction: "#ff8a5c", load: "#9be08a" };
/* Lengths of arrows, in bead radii for one weight of the bead.  The magnet pulls the bead down with some thirty, of which
 * dry friction may be a fifth: its arrow stays in the picture of a camera that rides with the bead. */
export const FRICTION = 0.4, LOAD = 0.12;
/* The colours of several beads, as in figures (FST_COLOURS, style.c), and the dot of two that touch. */
export const BEADS = ["#009e73", "#cc79a7", "#999933", "#56b4e9", "#e69f00", "#882255", "#ddcc77", "#44aa99"], TOUCH = "#ffffff";
/* The lines of a track, one for each of its beads. */
export const trackColours = (beads) => (beads > 1 ? BEADS : ["#ffffff"]);
