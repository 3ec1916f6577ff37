/* pace.js - when the page draws, and how fast the motion goes.  A frame is asked for where something moves or has
 * changed, and never otherwise: a page that stands still leaves the processor alone. */

/* Seconds of a frame that are made up for at most; what a frame may compute before its share shrinks, ms; over how
 * many seconds the factor of slow motion is measured, and after how many it is told. */
const LONGEST = 1, BUSY_MS = 24, MEMORY = 1, KNOWN = 0.5;

export class Pace {
    /* `draw(now)` makes a frame; `ask` and `clock` are the browser's, but for tests. */
    constructor(draw, ask = (call) => requestAnimationFrame(call), clock = () => performance.now()) {
        Object.assign(this, { draw, ask, clock, asked: false, share: 1 });
        this.reset();
    }

    wake() {
        if (this.asked)
            return;
        this.asked = true;
        this.ask((now) => {
            this.asked = false;
            this.draw(now);
        });
    }

    /* The motion begins, or goes on at another speed: what was measured before says nothing of it. */
    reset() {
        this.before = null;
        this.real = this.shown = 0;
    }

    /* Go on from the frame before to this one; `advance(seconds)` tells how many seconds of the bead it has done. */
    go(now, slow, advance) {
        const passed = (now - (this.before ?? now)) / 1e3, begun = this.clock();
        this.before = now;
        const done = advance((this.share * Math.min(LONGEST, passed)) / slow), took = this.clock() - begun;
        this.share = Math.max(0.05, Math.min(1, took > BUSY_MS ? (this.share * BUSY_MS) / took : this.share * 1.05));
        const kept = Math.exp(-passed / MEMORY);
        this.real = kept * this.real + passed;
        this.shown = kept * this.shown + done;
    }

    /* How many times slower than in reality the motion is, or null where that is not known yet. */
    get slower() {
        return this.real > KNOWN && this.shown > 0 ? this.real / this.shown : null;
    }
}

/* The factor to be told: the one that is set where the motion keeps it within a twentieth, else the true one. */
export function factorTold(set, slower) {
    return slower === null || Math.abs(slower / set - 1) < 0.05 ? set : Number(slower.toPrecision(2));
}
