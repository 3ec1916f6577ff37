/* texts.js - the languages of the page: a table of words for each (texts/), the one that is spoken now, and its numbers. */
import de from "./texts/de.js";
import en from "./texts/en.js";
import es from "./texts/es.js";
import fr from "./texts/fr.js";
import saidDe from "./texts/said/de.js";
import saidEn from "./texts/said/en.js";
import saidEs from "./texts/said/es.js";
import saidFr from "./texts/said/fr.js";
import saidZh from "./texts/said/zh.js";
import zh from "./texts/zh.js";

export const TABLES = { en, de, fr, es, zh };
export const SAID = { en: saidEn, de: saidDe, fr: saidFr, es: saidEs, zh: saidZh }; /* of the library's sentences: said.js */
export const LANGUAGES = { en: "English", de: "Deutsch", fr: "Français", es: "Español", zh: "中文" };

/* The words that are shown, and the decimal sign between digits.  Whoever shows them asks for them anew when the
 * language changes (Lab.speak). */
export let T = en;
let point = ".";

export function speak(language) {
    T = TABLES[language];
    point = new Intl.NumberFormat(T.lang).formatToParts(0.5).find(({ type }) => type === "decimal").value;
}

/* The first of a browser's languages that has a table, else English. */
export const languageOf = (wanted) => wanted.map((name) => name.slice(0, 2).toLowerCase()).find((name) => Object.hasOwn(TABLES, name)) ?? "en";

/* An error that the page itself has told, in its language. */
export class Told extends Error {}

/* A text with values in its places. */
export const say = (text, values) => text.replace(/\{(\w+)\}/g, (all, name) => values[name]);

/* Numbers in a text as the language writes them, with their signs and raised powers, and as the library, addresses and
 * files take them.  A comma before a digit can be nothing but a decimal sign, because the page writes no groups of digits: a
 * number that has some stays as it is, and the library refuses it; wide digits are Chinese keyboards'. */
const RAISED = { "^2": "²", "^3": "³" };
export const shown = (plain) => String(plain).replace(/(?<=\d)\.(?=\d)/g, point).replace(/(?<=^|[\s([,]|\de)-(?=\.?\d)/g, "\u2212").replace(/\^[23](?!\d)/g, (power) => RAISED[power]);
export const plainOf = (typed) => {
    const narrow = typed.replace(/[\uff0b-\uff5a]/g, (wide) => String.fromCharCode(wide.charCodeAt(0) - 0xfee0)).replace(/\u2212/g, "-").replace(/²/g, "^2").replace(/³/g, "^3").trim();
    return point === "," && !/\.\d+,/.test(narrow) ? narrow.replace(/,(?=\d)/g, ".") : narrow;
};
