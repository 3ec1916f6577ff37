/* state.js - what leaves the page and comes back as text: the address, scenes, tracks.  All of it is untrusted: it
 * becomes values and plain text, never markup. */

import { CAMERAS } from "./camera.js";
import { ARROWS, BEADS } from "./colours.js";
import { LANGUAGES, say, T, Told } from "./texts.js";
import { QUANTITIES } from "./trail.js";

/* The words of an address that are not a scene's, and what each may be. */
const isNumber = (text) => /^\s*\d/.test(text) && Number.isFinite(Number(text)), isOf = (table) => (text) => Object.hasOwn(table, text);
const VIEW = {
    "ui.slow": isNumber, "ui.camera": (text) => CAMERAS.includes(text), "ui.colour": isOf(QUANTITIES), "ui.trail": isNumber,
    "ui.arrows": (text) => text.split(",").every(isOf(ARROWS)), "ui.ramp": isNumber, "ui.settle": isNumber, "ui.step": isNumber,
    "ui.lang": isOf(LANGUAGES),
};
const LONGEST = 200, FARTHEST = 1e9, DISC = "0.1 mm";
const MILLIMETRES = new Map([["mm", 1], ["cm", 10], ["m", 1000], ["px", null]]);

/* The part of an address behind "#": scene and view, the keys that nobody knows, and words of the view that say nothing. */
export function readAddress(text, known) {
    const scene = {}, view = {}, unknown = [];
    for (const [key, value] of new URLSearchParams(text.replace(/^#/, ""))) {
        if (key === "v")
            continue;
        if (Object.hasOwn(VIEW, key) && VIEW[key](value))
            view[key] = value.slice(0, LONGEST);
        else if (Object.hasOwn(VIEW, key))
            unknown.push(`${key}=${value.slice(0, 60)}`);
        else if (known(key))
            scene[key] = value.slice(0, LONGEST);
        else
            unknown.push(key.slice(0, 60));
    }
    return { scene, view, unknown };
}

/* What is good of a scene from outside: `take` throws an error that names what is bad, and that is left out, a magnet
 * whose part is bad as a whole.  Returns the scene that was taken, and the errors. */
export function takeGood(scene, take) {
    const good = { ...scene }, errors = [];
    for (;;)
        try {
            take(good);
            return { scene: good, errors };
        } catch (error) {
            const keys = Object.keys(good), where = String(error.where ?? "");
            const bad = [keys.filter((key) => key === where), keys.filter((key) => key.startsWith(`${where.split(".")[0]}.`)), keys].find((list) => list.length);
            errors.push(error);
            if (!bad)
                return { scene: good, errors };
            bad.forEach((key) => delete good[key]);
        }
}

/* A scene after a choice, with what the choice needs and without what has no effect beside it, so that one step makes it:
 * a disc of contact has a size, which a point must not have.  What else is refused is returned as it is. */
export function fitted(scene, key, take) {
    const fit = { ...scene };
    for (;;)
        try {
            take(fit);
            return fit;
        } catch ({ where, message }) {
            if (where === "contact.patch" && fit[where] === "hertz" && !Object.hasOwn(fit, "contact.radius"))
                fit["contact.radius"] = DISC;
            else if (where !== key && Object.hasOwn(fit, where) && message.includes("has no effect"))
                delete fit[where];
            else
                return scene;
        }
}

export function writeAddress(scene, view) {
    const words = new URLSearchParams({ v: "1" });
    for (const [key, value] of [...Object.entries(scene), ...Object.entries(view)])
        words.set(key, value);
    return `#${words}`;
}

/* An item of a list, "magnet.parts[0].size[1]" or "beads[1].start.phi", and a component of a vector. */
const ITEM = /^([\w.]+)\[(\d+)\]\.([\w.]+?)(?:\[(\d)\])?$/, COMPONENT = /^([\w.]+)\[(\d)\]$/;

/* A scene as `festoon` reads it: groups with keys below them, lists of items, and vectors as lists of numbers. */
export function writeScene(scene, comment) {
    const groups = new Map(), lists = new Map();
    const put = (group, lines) => groups.set(group, [...(groups.get(group) || []), ...lines]);
    const give = (found, name, place, value) => {
        if (place === undefined)
            found[name] = value;
        else
            (found[name] ||= [])[Number(place)] = value;
    };
    const text = (value) => (Array.isArray(value) ? `[${Array.from(value, (cell) => cell ?? 0).join(", ")}]` : value);
    const values = new Map();
    for (const [key, value] of Object.entries(scene)) {
        const item = ITEM.exec(key), vector = COMPONENT.exec(key);
        if (item) {
            const list = lists.get(item[1]) || [];
            lists.set(item[1], list);
            give((list[Number(item[2])] ||= {}), item[3], item[4], value);
        } else {
            const [name, place] = vector ? [vector[1], vector[2]] : [key], found = values.get(name) || {};
            give(found, "value", place, value);
            values.set(name, found);
        }
    }
    for (const [key, { value }] of values)
        put(key.split(".")[0], [`  ${key.split(".")[1]}: ${text(value)}`]);
    for (const [key, items] of lists) {
        const [group, name] = key.split("."), indent = name ? "    " : "  ";
        const lines = items.flatMap((item) => Object.entries(item).map(([of, value], i) => `${indent}${i ? " " : "-"} ${of}: ${text(value)}`));
        put(group, [...(name ? [`  ${name}:`] : []), ...lines]);
    }
    return `# ${comment}\n${[...groups].map(([group, lines]) => `${group}:\n${lines.join("\n")}\n`).join("\n")}`;
}

/* The pairs of "{a: 1, b: [2, 3]}", which stand for lines of their own. */
function pairsOf(text) {
    const inner = /^\{(.*)\}$/.exec(text.trim());
    return inner ? inner[1].split(/,(?![^[]*\])/).map((pair) => /^\s*"?([A-Za-z_][\w.]*)"?\s*:\s*(.*?)\s*$/.exec(pair)) : null;
}

/* Read such a file: the plain part of YAML that scenes consist of.  A line that is none of it is an error. */
export function readScene(text) {
    const scene = Object.create(null); /* no key is there before it is given, whatever its name */
    let group = "", list = null;
    const put = (key, value, line) => {
        if (key in scene)
            throw new Told(say(T.bad.twice, { line, key: key.slice(0, 60) }));
        scene[key] = value.replace(/^(["'])(.*)\1$/, "$2").slice(0, LONGEST);
    };
    /* A value, or the components of a vector. */
    const give = (key, value, line) => {
        const row = /^\[(.*)\]$/.exec(value);
        if (row)
            row[1].split(",").forEach((cell, i) => put(`${key}[${i}]`, cell.trim(), line));
        else
            put(key, value, line);
    };
    text.replace(/^\uFEFF/, "").split(/\r?\n/).forEach((whole, index) => {
        const line = whole.replace(/(^|\s)#.*$/, "").trimEnd(), number = index + 1;
        const bad = () => new Told(say(T.bad.row, { line: number }));
        if (!line.trim() || line.trim() === "---")
            return;
        const flow = /^(\s*)- +(\{.*\})$/.exec(line), found = flow || /^(\s*)(- +)?"?([A-Za-z_][\w.[\]]*)"?\s*:\s*(.*)$/.exec(line);
        const begins = flow || found?.[2];
        if (begins && list === null && group)
            list = { key: group, depth: -1, count: 0 }; /* the list is the group itself, as of beads */
        if (!found || (begins && list === null))
            throw bad();
        const pairs = flow ? pairsOf(flow[2]) : pairsOf(found[4]);
        if (pairs?.some((pair) => !pair))
            throw bad();
        const indent = found[1].length, name = flow ? "" : found[3], value = flow ? "" : found[4];
        const depth = indent + (flow || !found[2] ? 0 : found[2].length);
        if (!indent && !begins && (value === "" || pairs)) {
            [group, list] = [name, null];
            pairs?.forEach(([, of, what]) => give(`${group}.${of}`, what, number));
        } else if (list !== null && (begins || depth > list.depth)) {
            list.count += begins ? 1 : 0;
            const key = `${list.key}[${list.count - 1}]`;
            for (const [, of, what] of flow ? pairs : [[null, name, value]])
                give(`${key}.${of}`, what, number);
        } else if (indent && value === "") {
            list = { key: `${group}.${name}`, depth: indent, count: 0 };
        } else {
            list = null;
            give(indent ? `${group}.${name}` : name, value, number);
        }
    });
    return { ...scene };
}

/* How the lines of a table fall into cells, by the line of names: at its commas, or else at the semicolons or tabs of a
 * spreadsheet, whose numbers may have decimal commas. */
export function cellsBy(names) {
    const sign = names.includes(",") ? "," : [";", "\t"].find((mark) => names.includes(mark)) ?? ",";
    return (line) => line.split(sign).map((cell) => {
        const bare = cell.trim().replace(/^"(.*)"$/, "$1");
        return sign === "," ? bare : bare.replace(/,(?=\d)/g, ".");
    });
}

/* A track as `festoon track` writes it, or any table with columns x and y: places in mm about their centre, of each bead
 * that the column track names. */
export function readTrack(text) {
    const lines = text.replace(/^\uFEFF/, "").split(/\r?\n/).map((line, index) => ({ line, number: index + 1 }))
        .filter(({ line }) => /[^\s;]/.test(line) && !/^"?#/.test(line));
    const names = lines[0]?.line || "", cells = cellsBy(names);
    const heads = cells(names).map((head) => /^(.*?)\s*(?:\[(.*)\])?$/.exec(head.slice(0, LONGEST)));
    const column = (name) => heads.findIndex((head) => head && head[1].toLowerCase() === name);
    const x = column("x"), y = column("y"), name = column("track"), tracks = new Map();
    if (x < 0 || y < 0)
        throw new Told(say(T.bad.columns, { line: lines[0]?.number || 1 }));
    const unit = heads[x][2] || "px", factor = MILLIMETRES.get(unit);
    if (factor === undefined)
        throw new Told(say(T.bad.unit, { line: lines[0].number, unit: unit.slice(0, 20) }));
    lines.slice(1).forEach(({ line, number }) => {
        const row = cells(line);
        if (!row[x] || !row[y])
            return;
        const point = [Number(row[x]), Number(row[y])];
        if (!point.every((value) => Math.abs(value) <= FARTHEST))
            throw new Told(say(T.bad.number, { line: number, most: FARTHEST }));
        const bead = row[name] ?? "", points = tracks.get(bead) ?? [];
        if (tracks.set(bead, points).size > BEADS.length)
            throw new Told(say(T.bad.beads, { line: number, most: BEADS.length }));
        points.push(point);
    });
    const lists = [...tracks.values()];
    if (lists.flat().length < 3)
        throw new Told(T.bad.few);
    if (lists.every((points) => points.every((p) => p[0] === points[0][0] && p[1] === points[0][1])))
        throw new Told(T.bad.same);
    return { tracks: centred(lists, factor || 1), unit: factor ? "mm" : "px" };
}

/* About the common centre of the circles that fit best, one of each list (least squares of x^2 + y^2 = 2 a x + 2 b y + c,
 * where each list has its own c). */
function centred(lists, factor) {
    const mean = (points, pick) => points.reduce((sum, p) => sum + pick(p), 0) / points.length, all = lists.flat();
    const mx = mean(all, (p) => p[0]), my = mean(all, (p) => p[1]);
    const places = lists.map((points) => points.map(([x, y]) => [x - mx, y - my, (x - mx) ** 2 + (y - my) ** 2]));
    const rows = places.flatMap((points) => {
        const own = [0, 1, 2].map((k) => mean(points, (p) => p[k]));
        return points.map((p) => p.map((value, k) => value - own[k]));
    });
    const [uu, vv, uv, us, vs] = [[0, 0], [1, 1], [0, 1], [0, 2], [1, 2]].map(([i, k]) => mean(rows, (p) => p[i] * p[k])), det = uu * vv - uv * uv;
    const [a, b] = det > 1e-12 * (uu + vv) ** 2 ? [(us * vv - vs * uv) / (2 * det), (vs * uu - us * uv) / (2 * det)] : [0, 0];
    return places.map((points) => points.map((p) => [factor * (p[0] - a), factor * (p[1] - b)]));
}
