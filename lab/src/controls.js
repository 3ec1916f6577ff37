/* controls.js - the parameters as controls, made from the library's own table.  A row has a name, a field that takes a
 * value with a unit, and where it makes sense a slider; what the library refuses is said below, in its own words. */

import { STATUS } from "./core.js";
import { told, toldPlace, write } from "./said.js";
import { plainOf, say, shown, T, Told } from "./texts.js";

/* Where sliders begin and end, in the unit that is shown; other rows go from a quarter to four times their default. */
const SLIDERS = {
    "drive.frequency": [1, 30, 0.1], "bead.radius": [1, 5, 0.05], "bead.mass": [0.05, 3, 0.01], "magnet.depth": [5, 40, 0.1],
    "magnet.width": [0, 80, 0.5], "magnet.half_length": [8, 50, 0.5], "magnet.lines": [1, 15, 1], "model.kappa": [0.1, 6, 0.01],
    "bead.inertia": [0.01, 0.66, 0.01], "friction.gamma": [30, 1000, 1], "friction.mu": [0, 1, 0.01], "friction.rolling_resistance": [0, 0.1, 0.001],
    "start.r": [0.1, 2, 0.01], "start.phi": [-180, 180, 1], "plate.radius": [30, 400, 5], "plate.gravity": [0, 20, 0.1],
};
/* The unit in which a row is shown, by the table's own, and its factor. */
export const SHOWN = {
    m: ["mm", 1e3], kg: ["g", 1e3], T: ["mT", 1e3], Hz: ["Hz", 1], "1/s": ["1/s", 1], deg: ["deg", 1], "m/s": ["mm/s", 1e3], "m/s^2": ["m/s^2", 1],
    "A m^2": ["mA m^2", 1e3], "kg/m^3": ["kg/m^3", 1], Pa: ["MPa", 1e-6],
};
const MAIN = ["drive.frequency", "friction.law", "friction.mu", "model.kappa", "magnet.depth", "bead.radius"];
const HIDDEN = new Set(["magnet.file", "magnet.parts"]);
/* What the page has no controls for: lists of beads and worlds, which a scene brings. */
const BEYOND = /^(medium|wave|world|coils|field|beads)\.|^plate\.(shape|bowl_radius|tilt)|^drive\.(waveform|amplitude|chirp|table)|^contact\.pair|^model\.chi$|^run\.(method|step|duration)$/;
export const isBeyond = (key) => BEYOND.test(key);

function element(name, attributes = {}, ...children) {
    const made = document.createElement(name);
    for (const [key, value] of Object.entries(attributes))
        if (key in made && typeof value !== "string")
            made[key] = value;
        else
            made.setAttribute(key, value);
    made.append(...children);
    return made;
}
export { element };

const plain = (value) => String(Number(value.toPrecision(8)));

/* Whether the browser refused memory: to the library, to a new instance of it, or to a script. */
const isMemory = (error) => error.status === STATUS.NO_MEMORY || /out of memory|allocation failed|could not allocate/i.test(error.message || "");

/* What the library says, without the names of C, in the language of the page; what a browser says is left as it is. */
export function sentence(error) {
    if (isMemory(error))
        return T.noMemory;
    if (error instanceof Told)
        return error.message;
    const words = (error.message || String(error)).replace(/\s*\((?:fst_\w+\(\)|festoon schema)[^)]*\)/g, "");
    return error.where && !/^fst_/.test(error.where) && !words.includes(error.where) ? say(T.pair, { name: toldPlace(error.where), value: told(words) }) : told(words);
}

export class Controls {
    /* `changed(key, text)` returns null, or what is wrong. */
    constructor(core, changed) {
        this.core = core;
        this.changed = changed;
        this.rows = new Map();
    }

    build(main, others) {
        const groups = new Map(), open = [...others.children].map((group) => group.open);
        main.replaceChildren();
        others.replaceChildren();
        for (const row of this.core.parameters) {
            if (HIDDEN.has(row.key) || isBeyond(row.key) || row.kind === "text") // a page reads no files
                continue;
            const made = this.row(row);
            if (MAIN.includes(row.key)) {
                made.order = MAIN.indexOf(row.key);
                continue;
            }
            const group = row.key.split(".")[0];
            groups.set(group, [...(groups.get(group) || []), made.box]);
        }
        for (const key of MAIN)
            if (this.rows.has(key))
                main.append(this.rows.get(key).box);
        for (const [name, boxes] of groups)
            others.append(element("details", { open: open[others.children.length] ?? false }, element("summary", {}, T.groups[name] || name), ...boxes));
    }

    row(info) {
        const id = `p-${info.key.replace(/\W/g, "-")}`, [unit, factor] = SHOWN[info.unit] || ["", 1];
        const name = T.names[info.key] || info.key, label = element("label", { for: id, title: info.key }, name.replace(/ (?=\S\S?$)/, "\u00a0"));
        const error = element("p", { class: "error", id: `${id}-error`, role: "alert" });
        const help = element("p", { class: "help", id: `${id}-help`, ...(T.help[info.key] ? {} : { lang: "en" }) }, T.help[info.key] ?? `${info.key}: ${info.doc}`);
        const more = element("button", { type: "button", class: "more", "aria-label": say(T.about, { name }), "aria-expanded": "false", "aria-controls": `${id}-help` }, "?");
        help.hidden = true;
        more.addEventListener("click", () => {
            help.hidden = !help.hidden;
            more.setAttribute("aria-expanded", String(!help.hidden));
        });
        const row = { info, unit, factor, error, label, slider: null };
        if (info.kind === "choice") {
            row.field = element("select", { id, "aria-describedby": `${id}-error` }, ...info.names.map((name) => element("option", { value: name }, T.choices[info.key]?.[name] || name)));
            row.field.addEventListener("change", () => this.take(row, row.field.value));
        } else {
            row.field = element("input", { id, type: "text", inputmode: "text", autocomplete: "off", spellcheck: "false", size: "9", "aria-describedby": `${id}-error` });
            row.field.addEventListener("change", () => this.take(row, row.field.value));
            row.slider = this.slider(row);
        }
        row.box = element("div", { class: "row" }, element("div", { class: "head" }, label, row.field, more), ...(row.slider ? [row.slider] : []), error, help);
        this.rows.set(info.key, row);
        return row;
    }

    slider(row) {
        const { info, factor } = row;
        let limits = SLIDERS[info.key];
        if (!limits && info.initial > 0)
            limits = [factor * info.initial / 4, factor * info.initial * 4, factor * info.initial / 50];
        if (!limits || ["run", "impact"].includes(info.key.split(".")[0]))
            return null;
        const [min, max, step] = limits;
        const made = element("input", { type: "range", min: plain(min), max: plain(max), step: plain(step), "aria-label": say(T.slider, { name: T.names[info.key] || info.key }) });
        made.addEventListener("input", () => this.take(row, `${made.value}${row.unit && ` ${row.unit}`}`, made));
        return made;
    }

    take(row, text, from) {
        const wrong = this.changed(row.info.key, row.info.kind === "choice" ? text : plainOf(text));
        write(row.error, wrong || "");
        if (wrong && row.info.kind === "choice")
            row.field.value = this.core.get(row.info.key);
        else if (wrong && from)
            from.value = String(this.core.value(row.info.key) * row.factor);
        row.field.setAttribute("aria-invalid", wrong ? "true" : "false");
        if (!wrong)
            this.show(from);
    }

    /* The values as the library has them now; `texts` are as they were typed.  What does nothing is not
     * offered: in a wave no magnet turns, and what floats rubs at no plate. */
    show(from, texts = this.texts || {}) {
        const wave = this.core.get("drive.waveform") === "wave", floats = this.core.get("plate.shape") === "none", hide = (key, when) => {
            this.rows.get(key).box.hidden = when;
        };
        this.texts = texts;
        this.rows.get("drive.frequency").label.textContent = wave ? T.waveFrequency : T.names["drive.frequency"];
        hide("magnet.depth", wave || floats);
        hide("friction.law", floats);
        hide("friction.mu", floats || this.core.get("friction.law") !== "coulomb");
        for (const [key, row] of this.rows) {
            const { info, unit, factor } = row, value = this.core.value(key), said = this.core.get(key);
            if (info.kind !== "choice" && row.field === document.activeElement && row.field.getAttribute("aria-invalid") === "true")
                continue;
            row.error.textContent = "";
            row.field.setAttribute("aria-invalid", "false");
            if (info.kind === "choice") {
                row.field.value = said;
                continue;
            }
            row.field.value = shown(/[a-z]/i.test(texts[key] || "") ? texts[key] : (said === "" ? "" : `${plain(value * factor)}${unit && ` ${unit}`}`));
            row.field.placeholder = said !== "" ? "" : unit ? shown(`… ${unit}`) : T.notGiven;
            if (row.slider)
                row.slider.hidden = said === ""; // it would show a value that is not there
            if (row.slider && row.slider !== from && said !== "")
                row.slider.value = String(value * factor);
        }
    }
}
