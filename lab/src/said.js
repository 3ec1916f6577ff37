/* said.js - the library's sentences in the language of the page.  The library speaks English; a pattern of texts/said/en.js
 * that fits a sentence is said in the words of the language.  What no pattern fits stays English and is marked, so that
 * write() tells a reader its language. */
import { SAID, say, shown, T } from "./texts.js";

/* Between these two a text is English.  They are private characters of Unicode, which no text from outside keeps. */
const BEGIN = "\ue000", END = "\ue001", MARKS = /[\ue000\ue001]/g;
/* Places that are patterns of some table themselves; of `words`, one word that is in no pattern (a key, a choice) may stay. */
const TABLE_OF = { rest: "sentences", told: "pieces", more: "pieces", does: "does", number: "numbers" };
for (const name of ["hint", "choose", "kind", "sizes", "count", "at", "how", "what", "way", "side", "group", "found"])
    TABLE_OF[name] = "words";
/* Places that are keys; that are what somebody wrote, which may be anything and stays as it is; others are numbers or names. */
const KEYS = new Set(["key", "other", "again", "next", "later", "first", "last"]);
const WRITTEN = new Set(["text", "unit", "better", "axis", "file", "names", "forms", "example", "rows", "column"]);
const shapeOf = (place) => (KEYS.has(place) ? "([\\w.[\\]]+)" : WRITTEN.has(place) ? "(.*?)" : TABLE_OF[place] ? "(.+?)" : "([^(;]+?)");

/* The patterns of a table, those with most words of their own first. */
function patternsOf(table) {
    return Object.entries(table).map(([name, text]) => {
        const parts = text.split(/\{(\w+)\}/), places = parts.filter((part, i) => i % 2);
        const source = parts.map((part, i) => (i % 2 ? shapeOf(part) : part.replace(/[.*+?^${}()|[\]\\/]/g, "\\$&"))).join("");
        return { name, places, own: parts.filter((part, i) => i % 2 === 0).join("").length, pattern: new RegExp(`^${source}$`, "s") };
    }).sort((a, b) => b.own - a.own);
}
const PATTERNS = Object.fromEntries(Object.entries(SAID.en).map(([name, table]) => [name, patternsOf(table)]));

/* A text by the patterns of a table, or null. */
function translated(text, table, words) {
    for (const { name, places, pattern } of PATTERNS[table]) {
        const found = pattern.exec(text);
        const values = found && places.map((place, i) => (TABLE_OF[place] ? translated(found[i + 1], TABLE_OF[place], words) : WRITTEN.has(place) ? found[i + 1] : shown(found[i + 1])));
        if (values && !values.includes(null))
            return say(words[table][name], Object.fromEntries(places.map((place, i) => [place, values[i]])));
    }
    return (table === "words" && /^\S+$/.test(text)) || (table === "numbers" && /^\d+$/.test(text)) ? shown(text) : null;
}

const english = (text) => `${BEGIN}${text}${END}`;

/* What the library says, in the language of the page. */
export function told(text, table = "sentences") {
    const plain = text.replace(MARKS, ""), words = SAID[T.lang.slice(0, 2)];
    return words === SAID.en ? plain : translated(plain, table, words) ?? english(plain);
}

/* Times and radii of a sentence, which the library says in the model's units, in those of the page. */
export const inUnits = (text, { length_unit_m, time_unit_s }) => text.replace(/\b([tr]) = (\d[\d.]*(?:e[+-]?\d+)?)/g,
    (all, name, value) => `${name} = ${Number((value * (name === "t" ? time_unit_s : 1e3 * length_unit_m)).toPrecision(4))} ${name === "t" ? "s" : "mm"}`);

/* A sentence that stands alone: with a capital and its end. */
export const whole = (text) => say(/[?？]\ue001?$/.test(text) ? "{text}" : T.sentence, { text: /^\ue000?[\w[\]]+[.:=]/.test(text) ? text : text.replace(/^\ue000?./u, (head) => head.toUpperCase()) });

/* Where something is wrong: a key, a line of a file, or a moment in words. */
export const toldPlace = (text) => translated(text.replace(MARKS, ""), "words", SAID[T.lang.slice(0, 2)]) ?? text.replace(MARKS, "");

/* Put a text into an element, as text alone, with the language of what is English in it. */
export function write(element, text) {
    element.replaceChildren(...text.split(/(\ue000[^\ue001]*\ue001)/).filter(Boolean).map((part) => {
        if (!part.startsWith(BEGIN))
            return part.replace(MARKS, "");
        const span = document.createElement("span");
        span.lang = "en";
        span.textContent = part.slice(1, -1);
        return span;
    }));
}
