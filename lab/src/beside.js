/* beside.js - two scenes side by side: the page twice within itself, each with all its controls. */
import { element } from "./controls.js";
import { T } from "./texts.js";

/* A page that is one of two has no two within. */
export const isOneOfTwo = () => Boolean(window.frameElement?.closest("#beside"));

/* The page in a frame goes on with a scene and its view. */
async function openIn(frame, { language, state, maps }) {
    await new Promise((resolve) => frame.addEventListener("load", resolve, { once: true }));
    const { lab } = await frame.contentWindow.festoonLab.ready;
    maps.forEach(({ name, bytes }) => lab.takeMap(name, bytes));
    lab.settings.language = language;
    lab.speak();
    lab.open(state);
    lab.play(true);
    return lab;
}

export async function openBeside(lab) {
    const box = document.getElementById("beside"), state = { scene: { ...lab.scene }, view: lab.viewWords() }, { open, ...words } = T.beside;
    const frames = [words.left, words.right].map((title) => element("iframe", { title, srcdoc: window.festoonPage }));
    const button = (id, text, act) => {
        const made = element("button", { type: "button", id }, text);
        made.addEventListener("click", act);
        return made;
    };
    lab.lesson.close();
    lab.play(false);
    const pages = frames.map((frame) => openIn(frame, { language: lab.language, state, maps: [...lab.pool.maps.values()] })), both = Promise.all(pages);
    const restart = button("beside-restart", words.restart, async () => (await both).forEach((one) => {
        one.restart();
        one.play(true);
    }));
    const close = button("beside-close", words.close, async () => {
        const left = await pages[0], view = left.viewWords(), scene = { ...left.scene };
        box.replaceChildren();
        document.body.classList.remove("beside-on");
        [...left.pool.maps.values()].forEach(({ name, bytes }) => lab.takeMap(name, bytes));
        lab.open({ scene, view });
        lab.play(true);
        document.getElementById("beside-open").focus();
    });
    box.replaceChildren(element("div", {}, restart, close), ...frames);
    document.body.classList.add("beside-on");
    close.focus();
    await both;
}
