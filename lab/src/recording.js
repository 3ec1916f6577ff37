/* recording.js - the motion of several beads, or of one in a world: samples of a run that a worker computes, and what lies
 * between them. */
import { COLUMN, COLUMNS } from "./core.js";

/* A row between two: all numbers by straight lines; the bead's turn the short way round. */
function between(a, b, part) {
    const row = a.map((value, i) => value + part * (b[i] - value)), at = COLUMN.turn;
    const near = a.slice(at, at + 4).reduce((sum, v, i) => sum + v * b[at + i], 0) < 0 ? -1 : 1;
    let size = 0;
    for (let i = at; i < at + 4; ++i) {
        row[i] = a[i] + part * (near * b[i] - a[i]);
        size += row[i] * row[i];
    }
    for (let i = at; i < at + 4; ++i)
        row[i] /= Math.sqrt(size);
    row[COLUMN.touches] = a[COLUMN.touches];
    return row;
}

export class Recording {
    constructor() {
        this.samples = [];
        this.done = false; /* no more samples will come */
        this.at = 0;
    }

    add(samples) {
        for (const sample of samples)
            this.samples.push(sample);
    }

    get end() {
        return this.samples.length ? this.samples.at(-1)[COLUMN.time] : 0;
    }

    /* The rows of a sample, one for each bead. */
    rows(index) {
        const sample = this.samples[index];
        return Array.from({ length: sample.length / COLUMNS }, (_, i) => sample.subarray(COLUMNS * i, COLUMNS * (i + 1)));
    }

    /* Go on to a time; `pass` gets the rows of each sample on the way.  Returns the rows at that time. */
    go(time, pass) {
        while (this.at + 1 < this.samples.length && this.samples[this.at + 1][COLUMN.time] <= time)
            pass(this.rows(++this.at));
        const here = this.rows(this.at), from = here[0][COLUMN.time];
        if (this.at + 1 === this.samples.length || time <= from)
            return here.map((row) => row.slice());
        const next = this.rows(this.at + 1), part = (time - from) / (next[0][COLUMN.time] - from);
        return here.map((row, i) => between(row, next[i], part));
    }
}
