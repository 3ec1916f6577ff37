/* camera.js - from where the bead is seen, and how fingers, mouse and keys move the eye.
 *
 * above: over the axis.  free: from any side.  magnet: riding with the magnet, in whose frame a festoon pattern is a
 * closed loop.  bead: riding with the bead. */
import { COLUMN } from "./core.js";

export const CAMERAS = ["above", "free", "magnet", "bead"];
const START = {
    above: { azimuth: -90, elevation: 90, zoom: 1 },
    free: { azimuth: -60, elevation: 34, zoom: 0.95 },
    magnet: { azimuth: -90, elevation: 90, zoom: 1 },
    bead: { azimuth: -115, elevation: 24, zoom: 1 },
};
const RADIANS = Math.PI / 180;

export class Camera {
    constructor() {
        this.mode = "free";
        this.places = structuredClone(START);
    }

    choose(mode) {
        if (mode === this.mode)
            this.places[mode] = { ...START[mode] };
        this.mode = mode;
    }

    get place() {
        return this.places[this.mode];
    }

    turn(right, up) {
        const place = this.place;
        place.azimuth -= right;
        place.elevation = Math.max(4, Math.min(90, place.elevation + up));
    }

    zoom(factor) {
        this.place.zoom = Math.max(0.2, Math.min(8, this.place.zoom * factor));
    }

    /* Eye, target and upward direction for a row; `reach` is the radius that is to be seen, `aspect` width over
     * height, `fov` the vertical angle in degrees. */
    look(row, eps, reach, aspect, fov) {
        const { azimuth, elevation, zoom } = this.place, close = this.mode === "bead";
        let a = azimuth * RADIANS;
        if (this.mode === "magnet")
            a += 2 * Math.PI * row[COLUMN.turns];
        if (close)
            a += Math.atan2(row[COLUMN.y], row[COLUMN.x]);
        const e = elevation * RADIANS;
        const seen = (close ? 4.2 * eps : reach) / zoom;
        const distance = seen / Math.tan((fov * RADIANS) / 2) / Math.min(1, aspect);
        const h = [Math.cos(a), Math.sin(a)];
        const target = close ? [row[COLUMN.x], row[COLUMN.y], eps] : [0, 0, -0.25 * Math.cos(e)];
        return {
            target, up: [-h[0] * Math.sin(e), -h[1] * Math.sin(e), Math.cos(e)],
            eye: [target[0] + distance * h[0] * Math.cos(e), target[1] + distance * h[1] * Math.cos(e),
                target[2] + distance * Math.sin(e)],
        };
    }

    /* Pointers on `element`: one turns, two pinch; the wheel zooms with Ctrl or on a focused view. */
    listen(element) {
        const pointers = new Map();
        let apart = 0;
        element.addEventListener("pointerdown", (event) => {
            pointers.set(event.pointerId, [event.clientX, event.clientY]);
            element.setPointerCapture?.(event.pointerId);
            apart = 0;
        });
        element.addEventListener("pointermove", (event) => {
            const before = pointers.get(event.pointerId);
            if (!before)
                return;
            pointers.set(event.pointerId, [event.clientX, event.clientY]);
            if (pointers.size === 1) {
                this.turn((event.clientX - before[0]) * 0.4, (event.clientY - before[1]) * 0.4);
                return;
            }
            const [p, q] = [...pointers.values()], now = Math.hypot(p[0] - q[0], p[1] - q[1]);
            if (apart > 0)
                this.zoom(now / apart);
            apart = now;
        });
        for (const name of ["pointerup", "pointercancel"])
            element.addEventListener(name, (event) => {
                pointers.delete(event.pointerId);
                apart = 0;
            });
        element.addEventListener("wheel", (event) => {
            event.preventDefault();
            this.zoom(Math.exp(-event.deltaY * 0.001));
        }, { passive: false });
        element.addEventListener("keydown", (event) => {
            const steps = { ArrowLeft: [-6, 0], ArrowRight: [6, 0], ArrowUp: [0, 5], ArrowDown: [0, -5] }[event.key];
            const zoom = { "+": 1.15, "=": 1.15, "-": 1 / 1.15 }[event.key];
            if (steps)
                this.turn(...steps);
            else if (zoom)
                this.zoom(zoom);
            else
                return;
            event.preventDefault();
        });
    }
}
