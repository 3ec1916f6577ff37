/* worker.js - a thread that runs beads: a scene, or single points of a grid. */
import { Core } from "./core.js";

let core;

function problem(error) {
    return { where: error.where || "", message: error.message, status: error.status ?? 1 };
}

async function answer({ id, kind, module, scene, axis, point }) {
    try {
        if (kind === "open") {
            core = await Core.open(module, (fraction) => {
                postMessage({ fraction });
                return 0;
            });
            postMessage({ id, done: true });
            return;
        }
        core.setScene(scene);
        if (kind === "point") {
            core.grid(axis);
            core.takePoint(point);
        }
        postMessage({ id, done: true, result: core.run() });
    } catch (error) {
        postMessage({ id, problem: problem(error) });
    }
}

onmessage = (event) => answer(event.data);
