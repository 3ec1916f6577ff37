/* camera.js - from where the bead is seen, and how fingers, mouse and keys move the eye.
 *
 * above: over the axis.  free: from any side.  magnet: riding with the magnet, in whose frame a festoon pattern is a
 * closed loop.  bead: riding with the bead. */
import { COLUMN } from "./core.js";

export const CAMERAS = ["above", "free", "magnet", "bead"];
const START = {
    above: { azimuth: -90, elevation: 90, zoom: 1 },
    free: { azimuth: -60, elevation: 38, zoom: 1 },
    magnet: { azimuth: -90, elevation: 90, zoom: 1 },
    bead: { azimuth: -115, elevation: 24, zoom: 1 },
};
const RADIANS = Math.PI / 180, MARGIN = 1.04;

/* How far the eye has to be, and how far up its target, so that circles about the axis just fill the picture below a
 * `strip` at its top, a share of its height: a point that is u up, w towards the eye and v aside is seen where
 * |u - shift| and |v|/aspect are below (distance - w) tan, and in the strip from 1 - 2 strip of that on. */
function fitHull(hull, elevation, tan, aspect, strip) {
    let above = 0, below = 0, aside = 0;
    for (const [radius, z] of hull)
        for (let i = 0; i < 48; ++i) {
            const along = radius * Math.cos((i * Math.PI) / 24), across = radius * Math.sin((i * Math.PI) / 24);
            const u = z * Math.cos(elevation) - along * Math.sin(elevation), w = z * Math.sin(elevation) + along * Math.cos(elevation);
            above = Math.max(above, u + w * tan);
            below = Math.max(below, w * tan - u);
            aside = Math.max(aside, Math.abs(across) / aspect + w * tan);
        }
    const half = MARGIN * Math.max((above + below) / (2 - 2 * strip), aside);
    return { distance: half / tan, shift: (above - below) / 2 + strip * half };
}

export class Camera {
    constructor() {
        this.chosen = "free";
        this.strip = 0; /* of the picture's height, at its top, lies under words */
        this.flat = false; /* a flat view shows nothing from the side */
        this.places = structuredClone(START);
    }

    choose(mode) {
        if (mode === this.chosen)
            this.places[mode] = { ...START[mode] };
        this.chosen = mode;
    }

    get mode() {
        return this.flat && this.chosen === "free" ? "above" : this.chosen;
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

    /* Eye, target and upward direction for a row; `hull` is what is to be seen, circles about the axis as [radius, z];
     * `aspect` is width over height, `fov` the vertical angle in degrees; `middle` is the place about which it is, where
     * that is not the axis. */
    look(row, eps, hull, aspect, fov, middle = [0, 0]) {
        const { azimuth, elevation, zoom } = this.place, close = this.mode === "bead";
        let a = azimuth * RADIANS;
        if (this.mode === "magnet")
            a += 2 * Math.PI * row[COLUMN.magnet];
        if (close)
            a += Math.atan2(row[COLUMN.y], row[COLUMN.x]);
        const e = elevation * RADIANS, tan = Math.tan((fov * RADIANS) / 2), h = [Math.cos(a), Math.sin(a)];
        const up = [-h[0] * Math.sin(e), -h[1] * Math.sin(e), Math.cos(e)];
        const fit = close ? { distance: (4.2 * eps) / tan / Math.min(1, aspect), shift: 0 } : fitHull(hull, e, tan, aspect, this.strip);
        const target = close ? [row[COLUMN.x], row[COLUMN.y], row[COLUMN.z]] : up.map((v, i) => fit.shift * v + (middle[i] || 0)), distance = fit.distance / zoom;
        return {
            target, up,
            eye: [target[0] + distance * h[0] * Math.cos(e), target[1] + distance * h[1] * Math.cos(e),
                target[2] + distance * Math.sin(e)],
        };
    }

    /* Pointers on `element`: one turns, two pinch; the wheel zooms.  `moved` hears of each. */
    listen(element, moved) {
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
                moved();
                return;
            }
            const [p, q] = [...pointers.values()], now = Math.hypot(p[0] - q[0], p[1] - q[1]);
            if (apart > 0)
                this.zoom(now / apart);
            apart = now;
            moved();
        });
        for (const name of ["pointerup", "pointercancel"])
            element.addEventListener(name, (event) => {
                pointers.delete(event.pointerId);
                apart = 0;
            });
        element.addEventListener("wheel", (event) => {
            event.preventDefault();
            this.zoom(Math.exp(-event.deltaY * 0.001));
            moved();
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
            moved();
        });
    }
}
