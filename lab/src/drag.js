/* drag.js - parts of a real magnet are moved with a pointer, where the view looks straight down on them. */
import { COLUMN } from "./core.js";

/* A place of the laboratory in the magnet's frame. */
function inMagnet([x, y], turns) {
    const c = Math.cos(2 * Math.PI * turns), s = Math.sin(2 * Math.PI * turns);
    return [c * x + s * y, c * y - s * x];
}

/* Whether a part has the place below it that a pointer shows; one that is turned counts as its outline would without. */
const covers = ({ centre, size }, [x, y]) => Math.abs(x - centre[0]) <= size[0] / 2 && Math.abs(y - centre[1]) <= (size.length > 2 ? size[1] : size[0]) / 2;

export const canDrag = (lab) => ["above", "magnet"].includes(lab.camera.mode) && lab.core.get("magnet.shape") === "parts" && lab.core.parts().length > 0;

/* Must listen before the camera, which turns the view with a pointer that holds no part. */
export function listenDrags(canvas, lab) {
    let held = null;
    const place = (event, z) => {
        const box = canvas.getBoundingClientRect();
        return inMagnet(lab.view.placeAt((event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height, z), lab.row[COLUMN.magnet]);
    };
    const move = (event) => {
        const at = place(event, held.z), centre = at.map((v, i) => (v + held.offset[i]) * lab.units.mm);
        const scene = { ...lab.scene };
        centre.forEach((v, i) => (scene[`magnet.parts[${held.index}].centre[${i}]`] = `${v.toFixed(2)} mm`));
        return lab.changeTo(scene, "magnet.parts");
    };
    const listen = (name, act) => canvas.addEventListener(name, (event) => {
        if (name === "pointerdown" ? !canDrag(lab) || held : event.pointerId !== held?.pointer)
            return;
        act(event);
        if (held || name !== "pointerdown")
            event.stopImmediatePropagation();
    });
    listen("pointerdown", (event) => {
        const tops = lab.bodies.map((body) => body.centre[2] + (body.kind === "cylinder" ? body.size[1] : body.size.at(-1)) / 2);
        const found = lab.bodies.map((body, index) => ({ body, index, z: tops[index] })).filter(({ body, z }) => covers(body, place(event, z))).sort((a, b) => b.z - a.z)[0];
        if (!found)
            return;
        const at = place(event, found.z);
        held = { index: found.index, z: found.z, offset: at.map((v, i) => found.body.centre[i] - v), pointer: event.pointerId, playing: lab.playing };
        lab.play(false); /* the magnet stands while it is held */
        canvas.setPointerCapture?.(event.pointerId);
    });
    listen("pointermove", (event) => {
        if (!lab.recording) /* a run that is recorded begins anew, so once is enough */
            lab.tell(move(event) ?? "", true);
    });
    listen("pointerup", (event) => {
        const wrong = move(event), { playing } = held;
        held = null;
        lab.tell(wrong ?? "", true);
        lab.play(playing);
    });
    listen("pointercancel", () => {
        held = null;
    });
}
