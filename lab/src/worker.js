/* worker.js - a thread that runs beads: a scene, single points of a grid, or a motion that is recorded. */
import { Core } from "./core.js";

const MOST_NUMBERS = 3e6, PIECE = 128; /* of a recording: 24 MB; samples that are sent at once */
let core, held; /* the checksum of the map that was read last */

function problem(error) {
    return { where: error.where || "", message: error.message, status: error.status ?? 1 };
}

/* Send the samples of the motion as they come. */
function record() {
    let samples = [], sent = 0;
    const send = () => {
        postMessage({ samples });
        samples = [];
    };
    core.record((rows) => {
        samples.push(Float64Array.from(rows));
        sent += rows.length;
        if (samples.length === PIECE)
            send();
        return sent > MOST_NUMBERS;
    });
    send();
}

async function answer({ id, kind, module, scene, map, axis, point }) {
    try {
        if (kind === "open") {
            core = await Core.open(module, (fraction) => {
                postMessage({ fraction });
                return 0;
            });
            postMessage({ id, done: true });
            return;
        }
        if (map && map.checksum !== held)
            held = core.readMap(map);
        core.setScene(scene);
        if (kind === "motion") {
            record();
            postMessage({ id, done: true });
            return;
        }
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
