/* view2d.js - the stirrer from above on a plain canvas, for browsers without WebGL. */
import { COLUMN } from "./core.js";
import { magnetisation, pictureOf } from "./magnet.js";
import { PALETTE } from "./trail.js";
import { ARROWS, FRICTION, GROUND, NORTH, SOUTH, TOUCH, trackColours } from "./colours.js";

export class View2D {
    constructor(canvas) {
        this.canvas = canvas;
        this.pen = canvas.getContext("2d");
        this.tracks = [];
        this.back = GROUND.screen;
    }

    lieOn(colour) {
        this.back = colour;
    }

    furnish(setup) {
        this.setup = setup;
        this.map = setup.map && pictureOf(setup.map);
    }

    showTrack(tracks) {
        this.tracks = tracks;
    }

    resize(width, height, ratio) {
        this.ratio = Math.min(ratio, 2);
        this.canvas.width = Math.round(width * this.ratio);
        this.canvas.height = Math.round(height * this.ratio);
    }

    /* The place of the laboratory that is seen at a place of the picture, given as shares of its sides. */
    placeAt(across, down) {
        const { x, y } = this.shown.inverse().transformPoint({ x: across * this.canvas.width, y: down * this.canvas.height });
        return [x, y];
    }

    draw({ rows, trails, range, camera, arrows }) {
        const { pen, canvas, setup } = this, row = rows[0], riding = camera.mode === "magnet", close = camera.mode === "bead";
        const phase = 2 * Math.PI * row[COLUMN.magnet], x = row[COLUMN.x], y = row[COLUMN.y];
        const reach = (close ? 6 * setup.eps : Math.max(...setup.hull.map(([radius]) => radius))) / camera.place.zoom;
        const scale = Math.min(canvas.width, canvas.height) / (2 * reach);
        pen.setTransform(1, 0, 0, 1, 0, 0);
        pen.fillStyle = this.back;
        pen.fillRect(0, 0, canvas.width, canvas.height);
        pen.setTransform(scale, 0, 0, -scale, canvas.width / 2, canvas.height / 2);
        pen.rotate(-((camera.place.azimuth + 90) * Math.PI) / 180 - (riding ? phase : 0));
        if (close || setup.follows)
            pen.translate(-x, -y);
        this.shown = pen.getTransform();
        this.plate(phase);
        if (setup.wave)
            this.wave(row, reach);
        pen.save();
        if (riding)
            pen.rotate(phase);
        trails.forEach((trail, i) => this.trail(trail, riding ? trail.turning : trail.lab, range, setup.colours?.[i]));
        pen.restore();
        const order = rows.map((_, i) => i).sort((a, b) => rows[a][COLUMN.z] - rows[b][COLUMN.z]); /* the upper ones cover others */
        order.forEach((i) => this.bead(rows[i], rows[i][COLUMN.x], rows[i][COLUMN.y], setup.radii[i], setup.colours?.[i]));
        this.touches(rows);
        this.arrows(row, x, y, arrows);
    }

    /* Bands where a travelling field points up and down. */
    wave(row, reach) {
        const { pen, setup } = this, step = setup.wave.length / 24, x = row[COLUMN.x];
        for (let at = step * Math.floor((x - 1.5 * reach) / step); at < x + 1.5 * reach; at += step) {
            const up = -setup.wave.sign * Math.sin(2 * Math.PI * ((at + step / 2) / setup.wave.length - row[COLUMN.turns]));
            pen.globalAlpha = 0.5 * Math.abs(up);
            pen.fillStyle = up > 0 ? NORTH : SOUTH;
            pen.fillRect(at, row[COLUMN.y] - 1.5 * reach, step, 3 * reach);
        }
        pen.globalAlpha = 1;
    }

    /* A dot where two beads touch. */
    touches(rows) {
        const { radii } = this.setup;
        this.pen.fillStyle = TOUCH;
        rows.forEach((row, i) => rows.slice(i + 1).forEach((other, k) => {
            const j = i + 1 + k, share = radii[i] / (radii[i] + radii[j]);
            if (Math.floor(row[COLUMN.touches] / 2 ** j) % 2)
                this.circle(row[COLUMN.x] + share * (other[COLUMN.x] - row[COLUMN.x]), row[COLUMN.y] + share * (other[COLUMN.y] - row[COLUMN.y]), 0.18 * radii[i]).fill();
        }));
    }

    plate(phase) {
        const { pen, setup } = this;
        pen.lineWidth = 0.008;
        pen.strokeStyle = "rgba(232,238,245,0.3)";
        pen.save();
        pen.rotate(phase);
        pen.globalAlpha = 0.55;
        for (const body of setup.bodies)
            this.body(body);
        if (this.map) {
            const { radius } = setup.map;
            pen.drawImage(this.map, -radius, -radius, 2 * radius, 2 * radius);
        }
        pen.restore();
        for (let i = 1; setup.plate !== "none" && i * setup.ring < Math.min(setup.plateRadius, 3.2); ++i)
            this.circle(0, 0, i * setup.ring).stroke();
        if (setup.plate !== "none")
            this.circle(0, 0, setup.plateRadius).stroke();
        this.tracks.forEach((points, i) => {
            pen.strokeStyle = trackColours(this.tracks.length)[i];
            pen.beginPath();
            points.forEach((p) => pen.lineTo(p[0], p[1]));
            pen.stroke();
        });
    }

    circle(x, y, radius) {
        this.pen.beginPath();
        this.pen.arc(x, y, radius, 0, 2 * Math.PI);
        return this.pen;
    }

    /* A body's outline, as if it stood straight, and its poles: both halves where they lie side by side, the upper one
     * where one lies on the other. */
    body(body) {
        const { pen } = this, { kind, centre, size } = body, axis = magnetisation(body);
        const [w, h] = kind === "cuboid" ? size : [size[0], size[0]];
        const main = axis.reduce((best, v, i) => (Math.abs(v) > Math.abs(axis[best]) * (1 + 1e-9) ? i : best), 0), sign = Math.sign(axis[main]) || 1;
        for (const half of main === 2 ? [sign] : [1, -1]) {
            pen.save();
            pen.beginPath();
            pen.rect(centre[0] + (main === 0 ? (half - 1) * w / 4 : -w / 2), centre[1] + (main === 1 ? (half - 1) * h / 4 : -h / 2),
                main === 0 ? w / 2 : w, main === 1 ? h / 2 : h);
            pen.clip();
            pen.fillStyle = (main === 2 ? sign > 0 : half === sign) ? NORTH : SOUTH;
            if (kind === "cuboid")
                pen.fillRect(centre[0] - w / 2, centre[1] - h / 2, w, h);
            else
                this.circle(centre[0], centre[1], w / 2).fill();
            pen.restore();
        }
    }

    trail(trail, places, range, own) {
        const { pen } = this, width = range[1] - range[0];
        pen.lineWidth = 0.022;
        for (let i = 1; i < trail.count; ++i) {
            const a = (trail.first + i - 1) % trail.room, b = (trail.first + i) % trail.room;
            const c = PALETTE[Math.floor(255 * Math.max(0, Math.min(1, (trail.value[b] - range[0]) / width)))];
            pen.strokeStyle = own || `rgb(${c.map((v) => Math.round(255 * v)).join()})`;
            pen.beginPath();
            pen.moveTo(places[2 * a], places[2 * a + 1]);
            pen.lineTo(places[2 * b], places[2 * b + 1]);
            pen.stroke();
        }
    }

    /* The bead from above: the side that its north pole faces is red, and a mark shows its turning. */
    bead(row, x, y, radius, colour) {
        const { pen } = this, [nx, ny, nz] = row.subarray(COLUMN.n, COLUMN.n + 3), across = Math.hypot(nx, ny);
        this.circle(x, y, radius);
        pen.fillStyle = SOUTH;
        pen.fill();
        pen.save();
        pen.translate(x, y);
        pen.rotate(Math.atan2(ny, nx));
        pen.beginPath();
        pen.arc(0, 0, radius, -Math.PI / 2, Math.PI / 2);
        pen.ellipse(0, 0, Math.abs(nz) * radius, radius, 0, Math.PI / 2, -Math.PI / 2, nz < 0);
        pen.fillStyle = NORTH;
        if (across > 1e-9 || nz > 0)
            pen.fill();
        pen.restore();
        this.marks(row, x, y, radius);
        pen.lineWidth = (colour ? 0.2 : 0.1) * radius;
        pen.strokeStyle = colour || "#f7f3e8";
        this.circle(x, y, radius).stroke();
    }

    marks(row, x, y, radius) {
        const { pen } = this, [a, b, c, w] = row.subarray(COLUMN.turn, COLUMN.turn + 4);
        const turned = ([p, q, r]) => {
            const t = [2 * (b * r - c * q), 2 * (c * p - a * r), 2 * (a * q - b * p)];
            return [p + w * t[0] + b * t[2] - c * t[1], q + w * t[1] + c * t[0] - a * t[2], r + w * t[2] + a * t[1] - b * t[0]];
        };
        pen.fillStyle = "#f7f3e8";
        for (const spot of [[1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0], [0, 0, 1]]) {
            const p = turned(spot);
            if (p[2] > 0)
                this.circle(x + radius * p[0], y + radius * p[1], 0.16 * radius).fill();
        }
    }

    arrows(row, x, y, wanted) {
        const { pen, setup } = this, e = setup.radii[0];
        const vectors = {
            moment: [3.2 * e * row[COLUMN.n], 3.2 * e * row[COLUMN.n + 1]],
            field: [3.2 * e * row[COLUMN.b] / setup.fieldScale, 3.2 * e * row[COLUMN.b + 1] / setup.fieldScale],
            friction: [FRICTION * e * row[COLUMN.force], FRICTION * e * row[COLUMN.force + 1]],
        };
        for (const [name, v] of Object.entries(vectors)) {
            const length = Math.hypot(...v);
            if (!wanted.has(name) || length < 0.1 * e)
                continue;
            const u = [v[0] / length, v[1] / length], tip = [x + v[0], y + v[1]], head = Math.min(length, 0.5 * e);
            pen.strokeStyle = pen.fillStyle = ARROWS[name];
            pen.lineWidth = 0.16 * e;
            pen.beginPath();
            pen.moveTo(x, y);
            pen.lineTo(tip[0] - u[0] * head, tip[1] - u[1] * head);
            pen.stroke();
            pen.beginPath();
            pen.moveTo(...tip);
            pen.lineTo(tip[0] - head * (u[0] - 0.5 * u[1]), tip[1] - head * (u[1] + 0.5 * u[0]));
            pen.lineTo(tip[0] - head * (u[0] + 0.5 * u[1]), tip[1] - head * (u[1] - 0.5 * u[0]));
            pen.fill();
        }
    }
}
