/* lesson.js - the lesson: in each step a question first, then the motion, then why it is so. */
import { element } from "./controls.js";
import { LESSON, T } from "./texts.js";

export class Lesson {
    constructor(lab, box) {
        this.lab = lab;
        this.box = box;
        this.at = -1;
        /* On a narrow page the lesson stands below the picture, elsewhere above the controls. */
        const narrow = window.matchMedia("(max-width: 700px)"), home = box.parentElement;
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
        document.getElementById("lesson-open").textContent = T.lesson;
        this.lab.remember();
    }

    open(index) {
        this.at = Math.max(0, Math.min(LESSON.length - 1, Number.isInteger(index) ? index : 0));
        const step = LESSON[this.at], { lab } = this;
        this.box.hidden = false;
        document.body.classList.add("lesson-on");
        document.getElementById("lesson-open").textContent = T.lessonClose;
        this.body = element("div", { class: "answers" });
        this.reply = element("div", { "aria-live": "polite" });
        this.heading = element("h2", { tabindex: "-1" }, `${T.lesson} ${this.at + 1}: ${step.title}`);
        step.answers.forEach((text, i) => {
            const button = element("button", { type: "button", "aria-pressed": "false" }, text);
            button.addEventListener("click", () => this.answer(i, button));
            this.body.append(button);
        });
        this.box.replaceChildren(this.heading, element("h3", {}, T.predict), element("p", {}, step.question), this.body, this.reply, this.steps());
        lab.hideTrail = true;
        lab.showTrack(null);
        lab.open({ scene: step.scene, view: { "ui.settle": String(step.settle ?? 0), ...step.view } });
        lab.play(false);
        document.body.classList.add("lesson-waits"); /* nothing tells the answer before it is given */
        this.heading.focus({ preventScroll: false });
    }

    steps() {
        const move = (text, by) => {
            const button = element("button", { type: "button" }, text);
            button.disabled = this.at + by < 0 || this.at + by >= LESSON.length;
            button.addEventListener("click", () => this.lab.replace(() => this.open(this.at + by)));
            return button;
        };
        return element("nav", { "aria-label": T.lesson }, move(T.back, -1), element("span", {}, T.lessonStep(this.at + 1, LESSON.length)), move(T.next, 1));
    }

    answer(index, button) {
        const step = LESSON[this.at], right = index === step.answer, why = element("button", { type: "button", class: "strong" }, T.why);
        for (const other of this.body.children)
            other.setAttribute("aria-pressed", String(other === button));
        this.reply.replaceChildren(element("p", { class: right ? "good" : "bad" }, right ? T.right : T.wrong), element("h3", {}, T.observe), element("p", {}, step.observe), why);
        why.addEventListener("click", () => why.replaceWith(element("h3", {}, T.explain), element("p", { class: "explain" }, step.explain)));
        document.body.classList.remove("lesson-waits");
        this.lab.play(true);
        if (step.plot)
            this.lab.panels.choosePlot(step.plot);
        if (step.sweep) {
            ["sweep-from", "sweep-to", "sweep-points"].forEach((id, i) => {
                document.getElementById(id).value = String(step.sweep[i]);
            });
            this.lab.panels.sweep();
        }
    }
}
