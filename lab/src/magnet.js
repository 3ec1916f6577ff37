/* magnet.js - what is drawn of the magnet: a list of bodies in its turning frame, in units of l, z from the plate.
 *
 * A body is {kind: "cuboid" | "cylinder" | "sphere", centre, size, axis, turn}: size as in a scene (three edges;
 * diameter and height; diameter), axis the direction of its magnetisation (its north pole), turn an optional
 * [degrees, x, y, z].  Both views draw any such list. */

/* The paper's bar is 56 mm long for lines of 46 mm, and 9 mm thick. */
const BAR_OVER_LINES = 56 / 46, BAR_THICKNESS = 9e-3;

/* A part of a real magnet, in SI units from the reference plane at a depth below the plate. */
function bodyOf(part, length, depth) {
    const [x, y, z] = part.centre, scaled = (list) => list.map((value) => value / length);
    return {
        kind: part.kind, centre: scaled([x, y, z - depth]), size: part.size ? scaled(part.size) : [0.12], axis: part.remanence || part.moment,
        turn: part.rotation?.[0] ? part.rotation : undefined,
    };
}

/* `north` is the sign of the end on +X, which the field itself tells; `parts` and `depth` are in metres. */
export function bodiesOf(groups, north, parts = [], depth = 0) {
    if (parts.length)
        return parts.map((part) => bodyOf(part, groups.length_unit_m, depth));
    const below = groups.h - groups.eps, width = groups.lambda * Math.max(groups.lines - 1, 0);
    return [{
        kind: "cuboid", centre: [0, 0, -below], axis: [north, 0, 0],
        size: [2 * BAR_OVER_LINES, Math.max(width, 0.08), Math.min(BAR_THICKNESS / groups.length_unit_m, 1.6 * below)],
    }];
}

/* The direction in which a body is magnetised, in the magnet's frame: its axis turned as the body is. */
export function magnetisation({ axis, turn }) {
    if (!turn)
        return axis;
    const [degrees, ...about] = turn, size = Math.hypot(...about) || 1, [x, y, z] = about.map((v) => v / size);
    const c = Math.cos((degrees * Math.PI) / 180), s = Math.sin((degrees * Math.PI) / 180), [a, b, d] = axis;
    const along = (1 - c) * (x * a + y * b + z * d);
    return [c * a + s * (y * d - z * b) + along * x, c * b + s * (z * a - x * d) + along * y, c * d + s * (x * b - y * a) + along * z];
}
