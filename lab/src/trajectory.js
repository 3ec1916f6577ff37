/* trajectory.js - a file of `festoon run --csv`: its scene, and its samples as rows that the page plays. */
import { COLUMN, COLUMNS } from "./core.js";
import { cellsBy, readScene } from "./state.js";
import { say, T, Told } from "./texts.js";

const TURN = 2 * Math.PI, MOST = 1e12;

/* A line of the head as a spreadsheet may have left it: quoted, and with semicolons or tabs for the commas that it took
 * for ends of cells, and behind it for the cells that are empty. */
const headLine = (line) => line.replace(/^"(.*)"([;\t]*)$/, "$1").replace(/""/g, '"').replace(/[;\t]+$/, "").replace(/[;\t]/g, ",");

/* What stands in such a file, or null if it is none: the scene of its head, the names and units of its columns, lines. */
export function readTrajectory(text) {
    if (!/^\uFEFF?"?# festoon trajectory/.test(text))
        return null;
    const lines = text.replace(/^\uFEFF/, "").split(/\r?\n/).map((line, index) => ({ line, number: index + 1 })).filter(({ line }) => /[^\s;]/.test(line));
    const isHead = ({ line }) => /^"?#/.test(line), scene = lines.filter(isHead).map(({ line }) => headLine(line)).filter((line) => line.startsWith("#   ")).map((line) => line.slice(4));
    const [names, ...rows] = lines.filter((line) => !isHead(line)), cells = cellsBy(names?.line ?? "");
    const columns = new Map(cells(names?.line ?? "").map((name, at) => [/^\S*/.exec(name)[0], { at, unit: /\[(.*)\]/.exec(name)?.[1] ?? "" }]));
    return { scene: readScene(scene.join("\n")), columns, rows: rows.map(({ line, number }) => ({ cells: cells(line), number })) };
}

/* Factors from the units of a file (--units scaled, lab or si) to those of a row: scaled ones, loads in weights. */
function factorsOf(core) {
    const { length_unit_m: l, time_unit_s: s, mass_kg: m, gravity } = core.groups(), weight = m * core.value("plate.gravity");
    return new Map([["1", 1], ["turn", 1], ["l", 1], ["mm", 1e-3 / l], ["m", 1 / l], ["1/gamma", 1], ["s", 1 / s], ["l gamma", 1], ["mm/s", (1e-3 * s) / l], ["m/s", s / l],
        ["gamma", 1], ["Hz", TURN * s], ["rad/s", s], ["1/s", s], ["l gamma^2", 1 / gravity], ["mN", 1e-3 / weight], ["N", 1 / weight]]);
}

/* The samples of a trajectory as the page records them, of the scene that the library has now. */
export function recordingOf({ columns, rows }, core) {
    const factors = factorsOf(core), { eps } = core.groups(), beads = core.radii().length, listed = columns.has("X_0");
    const column = (name) => {
        const { at, unit } = columns.get(name) ?? {}, factor = factors.get(unit);
        return factor === undefined ? null : { name, at, factor };
    };
    const needed = (name) => column(name) ?? (() => {
        throw new Told(say(T.bad.missing, { name }));
    })();
    /* Of one bead on a plate, z is the height of its lowest point. */
    const state = [...(listed ? ["X", "Y", "Z", "vX", "vY", "vZ"] : ["X", "Y", "z", "vX", "vY", "vz"]), "nX", "nY", "nZ", "WX", "WY", "WZ"];
    const read = [needed("t"), needed("drive_turns")];
    for (let i = 0; i < beads; ++i)
        read.push(...state.map((name) => needed(listed ? `${name}_${i}` : name)));
    const samples = new Float64Array(rows.length * read.length);
    rows.forEach(({ cells, number }, i) => read.forEach(({ name, at, factor }, k) => {
        const value = Number(cells[at] || NaN) * factor;
        if (!(Math.abs(value) < MOST))
            throw new Told(say(T.bad.cell, { line: number, name }));
        if (k === 0 && i > 0 && value <= samples[(i - 1) * read.length])
            throw new Told(say(T.bad.time, { line: number }));
        samples[i * read.length + k] = value + (!listed && k === 4 ? eps : 0);
    }));
    if (rows.length < 3)
        throw new Told(T.bad.few);
    const made = [];
    core.replay(samples, rows.length, (seen) => {
        made.push(fillForces(Float64Array.from(seen), rows[made.length].cells, beads, listed, column));
        return false;
    });
    return made;
}

/* What states do not tell: loads, friction and contacts. */
function fillForces(row, cells, beads, listed, column) {
    const put = (place, found) => {
        const value = found ? Number(cells[found.at] || NaN) * found.factor : NaN;
        row[place] = Number.isFinite(value) ? value : 0;
    };
    for (let i = 0; i < beads; ++i)
        put(i * COLUMNS + COLUMN.load, column(listed ? `load_${i}` : "load"));
    if (!listed)
        for (const [place, name] of Object.entries({ friction: "friction", use: "friction_use", sticks: "sticking" }))
            put(COLUMN[place], column(name));
    for (let i = 0; i < beads; ++i)
        for (let k = i + 1; k < beads; ++k) {
            const force = column(`force_${i}_${k}`), cell = force && cells[force.at];
            if (cell && Number.isFinite(Number(cell))) {
                row[i * COLUMNS + COLUMN.touches] += 2 ** k;
                row[k * COLUMNS + COLUMN.touches] += 2 ** i;
            }
        }
    return row;
}
