/* trail.js - where the bead has been: places in the laboratory and in the magnet's frame, and the quantity by which
 * the trail is coloured. */
import { COLUMN } from "./core.js";

export const SPACING = 1 / 96; /* turns of the magnet between two places */
const DEGREES = 180 / Math.PI;

/* The quantities by which a trail may be coloured: how one is read off a row, and its unit (factor from scaled). */
export const QUANTITIES = {
    nz: { read: (row) => row[COLUMN.nLocal + 2], unit: "" },
    r: { read: (row, s) => row[COLUMN.r] * s.mm, unit: "mm" },
    field: { read: (row, s) => row[COLUMN.field] * s.field, unit: (s) => (s.tesla ? "mT" : "B₀") },
    slip: { read: (row, s) => row[COLUMN.slipSize] * s.speed, unit: "mm/s" },
    speed: { read: (row, s) => row[COLUMN.speed] * s.speed, unit: "mm/s" },
    load: { read: (row) => row[COLUMN.load], unit: "weights" },
    use: { read: (row) => row[COLUMN.use], unit: "" },
    sticks: { read: (row) => row[COLUMN.sticks], unit: "", range: [0, 1] },
    angle: { read: (row) => row[COLUMN.angle] * DEGREES, unit: "°" },
    spin: { read: (row, s) => row[COLUMN.spin] / s.seconds / (2 * Math.PI), unit: "Hz" },
    time: { read: (row) => row[COLUMN.time], unit: "s" },
    z: { read: (row, s) => row[COLUMN.z] * s.mm, unit: "mm" },
};

/* Factors from the scaled units of a row to those that are shown. */
export function unitsOf(groups) {
    const tesla = groups.field_unit_t !== null;
    return {
        mm: 1e3 * groups.length_unit_m, seconds: groups.time_unit_s,
        speed: 1e3 * groups.length_unit_m / groups.time_unit_s, tesla, field: tesla ? 1e3 * groups.field_unit_t : 1,
    };
}

export class Trail {
    constructor(room) {
        this.room = room;
        this.lab = new Float32Array(2 * room);
        this.turning = new Float32Array(2 * room);
        this.height = new Float32Array(room);
        this.value = new Float32Array(room);
        this.samples = [];
        this.clear();
    }

    clear() {
        this.count = this.first = 0;
        this.last = -Infinity;
        this.samples.length = 0;
    }

    /* Take a row where the magnet has turned on far enough; keep the last `turns` turns. */
    take(row, quantity, units, turns) {
        if (row[COLUMN.turns] - this.last < SPACING * 0.999)
            return false;
        this.last = row[COLUMN.turns];
        const at = (this.first + this.count) % this.room;
        if (this.count === this.room)
            this.first = (this.first + 1) % this.room;
        else
            this.count += 1;
        this.lab[2 * at] = row[COLUMN.x];
        this.lab[2 * at + 1] = row[COLUMN.y];
        this.height[at] = row[COLUMN.z];
        this.turning[2 * at] = row[COLUMN.r] * Math.cos(row[COLUMN.phi]);
        this.turning[2 * at + 1] = row[COLUMN.r] * Math.sin(row[COLUMN.phi]);
        this.value[at] = quantity.read(row, units);
        this.samples.push(Float64Array.from(row));
        const most = Math.min(this.room, Math.round(turns / SPACING));
        while (this.count > most) {
            this.first = (this.first + 1) % this.room;
            this.count -= 1;
        }
        if (this.samples.length > 2 * this.room)
            this.samples.splice(0, this.room);
        return true;
    }

    /* The values anew, by another quantity. */
    colourBy(quantity, units) {
        const rows = this.samples.slice(-this.count);
        rows.forEach((row, i) => {
            this.value[(this.first + i) % this.room] = quantity.read(row, units);
        });
    }

    /* What the colours range over. */
    range(quantity) {
        if (quantity.range || this.count === 0)
            return quantity.range || [0, 1];
        let least = Infinity, most = -Infinity;
        for (let i = 0; i < this.count; ++i) {
            const value = this.value[(this.first + i) % this.room];
            least = Math.min(least, value);
            most = Math.max(most, value);
        }
        const spare = least < most ? 0 : 1e-3 * (Math.abs(least) || 1); /* a bead at rest has one value */
        return [least - spare, most + spare];
    }
}

/* A map of colours that stays readable in gray and for people who see few colours: dark violet to light yellow. */
const STOPS = [[68, 40, 130], [58, 82, 170], [33, 130, 160], [35, 165, 130], [110, 200, 90], [250, 225, 60]];
export function colourAt(share) {
    const at = Math.max(0, Math.min(0.9999, share)) * (STOPS.length - 1), i = Math.floor(at), f = at - i;
    return STOPS[i].map((value, k) => (value * (1 - f) + STOPS[i + 1][k] * f) / 255);
}
export const PALETTE = Array.from({ length: 256 }, (_, i) => colourAt(i / 255));
