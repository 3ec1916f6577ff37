/* main.js - how the page begins: its library, its threads, what it offers to scripts, and the parts of the page. */
import { Controls, sentence } from "./controls.js";
import { Core } from "./core.js";
import { Files } from "./files.js";
import { listenKeys } from "./keys.js";
import { Lesson } from "./lesson.js";
import { Lab, SLOWS } from "./page.js";
import { Panels } from "./panels.js";
import { Pool } from "./pool.js";
import { write } from "./said.js";
import { languageOf, say, speak, T } from "./texts.js";

const $ = (id) => document.getElementById(id);

async function begin() {
    const module = await WebAssembly.compile(await window.festoonUnpack("library").arrayBuffer()), core = await Core.open(module);
    const address = URL.createObjectURL(new Blob([WORKER_SOURCE], { type: "text/javascript" }));
    const threads = Math.max(1, Math.min(8, (navigator.hardwareConcurrency || 2) - 1));
    const pool = new Pool(module, address, threads), lab = new Lab(core, pool);
    Object.assign(window.festoonLab, {
        version: core.version, resultsVersion: core.resultsVersion, core, lab,
        run: (scene = {}) => pool.run({ ...scene }),
        stop: () => pool.stop(),
        sweep: async (scene, axis, take = () => {}) => {
            const probe = await Core.open(module), map = pool.mapOf(scene);
            if (map)
                probe.readMap(map);
            probe.setScene(scene);
            const values = probe.grid(axis), rows = new Array(values.length);
            await pool.sweep({ ...scene }, axis, values.length, (point, result) => {
                rows[point] = result;
                take(point, values[point], result);
            });
            return rows;
        },
    });
    lab.controls = new Controls(core, (key, text) => lab.change(key, text));
    lab.panels = new Panels(lab, SLOWS);
    lab.lesson = new Lesson(lab, $("lesson"));
    lab.files = new Files(lab);
    lab.panels.listen();
    lab.speak();
    lab.openView();
    lab.openAddress();
    if (lab.camera.flat && !$("notice").textContent)
        lab.tell(T.noWebgl);
    listenKeys(lab);
    window.addEventListener("hashchange", () => lab.openAddress());
    document.addEventListener("visibilitychange", () => lab.pace.reset());
    return window.festoonLab;
}

speak(languageOf(navigator.languages));
document.documentElement.lang = T.lang;
/* loader.js calls them. */
window.festoonLab.couldNotBegin = (error) => write($("notice"), say(T.couldNotBegin, { why: sentence(error) }));
window.festoonLab.begin = begin;
