/* lesson.js - the lesson: in each step a question first, then the motion, then why it is so. */
import { element } from "./controls.js";
import { LESSON } from "./scenes.js";
import { say, shown, T } from "./texts.js";
import { printWorksheet } from "./worksheet.js";

export class Lesson {
    constructor(lab, box) {
        this.lab = lab;
        this.box = box;
        this.at = -1;
        /* On a narrow page the lesson stands below the picture, elsewhere above the controls. */
        const narrow = (this.narrow = window.matchMedia("(max-width: 700px)")), home = box.parentElement;
        const settle = () => (narrow.matches ? document.getElementById("camera-help").after(box) : home.prepend(box));
        narrow.addEventListener("change", settle);
        settle();
    }

    toggle() {
        if (this.at >= 0)
            this.close();
        else
            this.lab.replace(() => this.open(0));
    }

    close() {
        if (this.at < 0)
            return;
        this.at = -1;
        this.lab.hideTrail = false;
        this.box.hidden = true;
        document.body.classList.remove("lesson-on", "lesson-waits");
        this.build();
        this.lab.remember();
    }

    open(index) {
        this.at = Math.max(0, Math.min(LESSON.length - 1, Number.isInteger(index) ? index : 0));
        this.given = null; /* the place of the answer, and whether the reason was asked for */
        this.told = false;
        const step = LESSON[this.at], { lab } = this;
        this.box.hidden = false;
        document.body.classList.add("lesson-on");
        this.build();
        lab.hideTrail = true;
        lab.open({ scene: step.scene, view: { "ui.settle": String(step.settle ?? 0), ...step.view } });
        lab.play(false);
        lab.panels.choosePlot("phi");
        document.getElementById("view-box").scrollIntoView({ block: "nearest" }); /* a step before may have gone to the curves */
        document.body.classList.add("lesson-waits"); /* nothing tells the answer before it is given */
        this.heading.focus({ preventScroll: true });
        if (this.narrow.matches)
            this.box.scrollIntoView(); /* right below the picture */
    }

    /* The words of the step as far as it has come. */
    build() {
        document.getElementById("lesson-open").textContent = this.at < 0 ? T.lessonName : T.lessonClose;
        if (this.at < 0)
            return;
        const words = T.lesson[this.at], sheet = element("button", { type: "button", id: "worksheet-open" }, T.worksheet.open);
        this.body = element("div", { class: "answers" });
        this.reply = element("div", { "aria-live": "polite" });
        this.heading = element("h2", { tabindex: "-1" }, say(T.lessonTitle, { n: this.at + 1, title: words.title }));
        words.answers.forEach((text, i) => {
            const button = element("button", { type: "button", "aria-pressed": String(i === this.given) }, text);
            button.addEventListener("click", () => this.answer(i));
            this.body.append(button);
        });
        sheet.addEventListener("click", printWorksheet);
        this.box.replaceChildren(this.heading, element("h3", {}, T.predict), element("p", {}, words.question), this.body, this.reply, sheet, this.steps());
        if (this.given !== null)
            this.observe();
    }

    steps() {
        const move = (text, by) => {
            const button = element("button", { type: "button" }, text);
            button.disabled = this.at + by < 0 || this.at + by >= LESSON.length;
            button.addEventListener("click", () => this.lab.replace(() => this.open(this.at + by)));
            return button;
        };
        return element("nav", { "aria-label": T.lessonName }, move(T.back, -1), element("span", {}, say(T.lessonStep, { n: this.at + 1, all: LESSON.length })), move(T.next, 1));
    }

    /* What to look at, once an answer is given, and the reason, once it is asked for. */
    observe() {
        const { observe, explain } = T.lesson[this.at], right = this.given === LESSON[this.at].answer, why = element("button", { type: "button", class: "strong" }, T.why);
        const reason = () => {
            this.told = true;
            why.replaceWith(element("h3", {}, T.explain), element("p", { class: "explain" }, explain));
        };
        this.reply.replaceChildren(element("p", { class: right ? "good" : "bad" }, right ? T.right : T.wrong), element("h3", {}, T.observe), element("p", {}, observe), why);
        why.addEventListener("click", reason);
        if (this.told)
            reason();
    }

    answer(index) {
        const step = LESSON[this.at];
        [this.given, this.told] = [index, false];
        [...this.body.children].forEach((button, i) => button.setAttribute("aria-pressed", String(i === index)));
        this.observe();
        document.body.classList.remove("lesson-waits");
        this.lab.play(true);
        if (step.plot) {
            this.lab.panels.choosePlot(step.plot);
            document.getElementById("plots").scrollIntoView({ block: "nearest" });
        }
        if (step.sweep) {
            ["sweep-from", "sweep-to", "sweep-points"].forEach((id, i) => {
                document.getElementById(id).value = shown(step.sweep[i]);
            });
            this.lab.panels.sweep();
        }
    }
}
