/* magnet.js - what is drawn of the magnet: a list of bodies in its turning frame, in units of l, z from the plate.
 *
 * A body is {kind: "cuboid" | "cylinder" | "sphere", centre, size, axis, turn}: size as in a scene (three edges;
 * diameter and height; diameter), axis the direction of its magnetisation (its north pole), turn an optional
 * [degrees, x, y, z].  Both views draw any such list. */
import { NORTH, SOUTH } from "./colours.js";

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

/* `north` is the sign of the end on +X, which the field itself tells; `parts` and `depth` are in metres; a magnet that is
 * told by its parts may have none. */
export function bodiesOf(groups, north, parts = [], depth = 0, real = parts.length > 0) {
    if (real)
        return parts.map((part) => bodyOf(part, groups.length_unit_m, depth));
    const below = groups.h - groups.eps, width = groups.lambda * Math.max(groups.lines - 1, 0);
    return [{
        kind: "cuboid", centre: [0, 0, -below], axis: [north, 0, 0],
        size: [2 * BAR_OVER_LINES, Math.max(width, 0.08), Math.min(BAR_THICKNESS / groups.length_unit_m, 1.6 * below)],
    }];
}

/* A scene whose magnet is a measured field, the last that was given to the page; and one that has another. */
export const withoutMap = ({ "magnet.file": file, "magnet.checksum": checksum, ...scene }) => scene;
export function withMap(scene, map) {
    const others = Object.entries(withoutMap(scene)).filter(([key]) => !/^magnet\.(parts|lines$|width$)|^model\.lambda$/.test(key));
    return { ...Object.fromEntries(others), "magnet.shape": "grid", ...(map ? { "magnet.file": map.name, "magnet.checksum": map.checksum } : {}) };
}

/* A measured field as a picture, its first row at the least y: red where it points up, blue where down. */
export function pictureOf({ side, up }) {
    const canvas = document.createElement("canvas"), pen = canvas.getContext("2d"), most = Math.max(...up.map((v) => Math.abs(v) || 0)) || 1;
    canvas.width = canvas.height = side;
    up.forEach((v, i) => {
        pen.globalAlpha = Math.sqrt(Math.abs(v) / most) || 0;
        pen.fillStyle = v > 0 ? NORTH : SOUTH;
        pen.fillRect(i % side, Math.floor(i / side), 1, 1);
    });
    return canvas;
}

/* What a view has to show, as circles about the axis, [radius, z]: the place of the path, and all that the bodies sweep
 * as they turn, as far as that is of the bead's size of things. */
const FARTHEST = 3;
export function hullOf(bodies, reach, eps, low = 0, high = 2 * eps) {
    const circles = bodies.flatMap(({ kind, centre, size, turn }) => {
        const edges = kind === "cuboid" ? size : kind === "cylinder" ? [size[0], size[0], size[1]] : [size[0], size[0], size[0]];
        const diagonal = Math.hypot(...edges), [x, y, z] = turn && kind !== "sphere" ? [diagonal, diagonal, diagonal] : edges, far = (at, edge) => Math.abs(at) + edge / 2;
        const radius = kind === "cuboid" ? Math.hypot(far(centre[0], x), far(centre[1], y)) : Math.hypot(centre[0], centre[1]) + x / 2;
        return [1, -1].map((side) => [Math.min(FARTHEST, radius), Math.max(-FARTHEST, centre[2] + (side * z) / 2)]);
    });
    return [[reach, low], [reach, high], ...circles];
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
