/* worksheet.js - the lesson as sheets to be printed and filled in: its questions, lines to write on, a table to measure. */
import { element } from "./controls.js";
import { LESSON } from "./scenes.js";
import { shown, T } from "./texts.js";

/* Speeds on both sides of the critical one, in Hz. */
const SPEEDS = [3, 6, 8.5, 9.1, 10.7, 14.5, 19.9], LINES = 2;

const lines = (text) => [element("p", {}, text), ...Array.from({ length: LINES }, () => element("p", { class: "line" }))];

function question(step, i) {
    return element("section", {}, element("h2", {}, `${i + 1}. ${step.title}`), element("p", {}, step.question),
        element("ul", {}, ...step.answers.map((answer) => element("li", {}, answer))), ...lines(T.worksheet.see), ...lines(T.worksheet.reason));
}

function table() {
    const { columns } = T.worksheet, names = Object.keys(columns);
    return element("table", {}, element("thead", {}, element("tr", {}, ...names.map((name) => element("th", { scope: "col" }, columns[name])))),
        element("tbody", {}, ...SPEEDS.map((speed) => element("tr", {}, ...names.map((name) => element("td", {}, name === "f" ? shown(speed) : ""))))));
}

/* Print the sheets in the place of the page. */
export function printWorksheet() {
    const { worksheet: words } = T, sheet = document.getElementById("worksheet");
    sheet.replaceChildren(element("h1", {}, words.title),
        element("p", { class: "whose" }, ...[words.name, words.group, words.date].map((name) => element("span", {}, name))), element("p", {}, words.intro),
        ...LESSON.map((step, i) => question(T.lesson[i], i)),
        element("section", {}, element("h2", {}, words.measure), element("p", {}, words.task), table(), element("p", {}, words.critical)));
    document.body.classList.add("on-worksheet");
    window.addEventListener("afterprint", () => document.body.classList.remove("on-worksheet"), { once: true });
    window.print();
}
