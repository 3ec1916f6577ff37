/* pool.js - runs and sweeps in workers.  A worker that must stop is ended and replaced: a page opened from a file may
 * share no memory with its workers, so there is no flag that a busy one could look at. */
import { FestoonError, STATUS } from "./core.js";
import { T, Told } from "./texts.js";

class Runner {
    constructor(pool) {
        this.pool = pool;
        this.worker = null;
        this.waiting = null;
        this.next = 0;
    }

    send(message) {
        return new Promise((resolve, reject) => {
            this.waiting = { id: ++this.next, resolve, reject };
            this.worker.postMessage({ ...message, id: this.next });
        });
    }

    async begin() {
        if (this.worker)
            return;
        this.worker = new Worker(this.pool.address);
        this.worker.onmessage = ({ data }) => this.hear(data);
        this.worker.onerror = (event) => this.waiting?.reject(event.message ? new Error(event.message) : new Told(T.workerFailed));
        this.ready = false;
        await this.send({ kind: "open", module: this.pool.module });
        this.ready = true;
    }

    hear(data) {
        if (data.samples) {
            this.onSamples?.(data.samples);
            return;
        }
        if (data.fraction !== undefined) {
            this.onFraction?.(data.fraction);
            return;
        }
        const waiting = this.waiting;
        if (!waiting || data.id !== waiting.id)
            return;
        this.waiting = null;
        if (data.problem)
            waiting.reject(new FestoonError(data.problem.status, data.problem.where, data.problem.message));
        else
            waiting.resolve(data.result);
    }

    async ask(message, onFraction) {
        this.onFraction = onFraction;
        try {
            await this.begin();
            return await this.send({ ...message, map: this.pool.mapOf(message.scene) });
        } catch (error) {
            if (!this.ready || error.status === STATUS.NO_MEMORY)
                this.end(); /* one without the library answers nothing, and one that is full holds on to what it has */
            throw error;
        }
    }

    end() {
        const waiting = this.waiting;
        this.worker?.terminate();
        this.worker = this.waiting = null;
        waiting?.reject(new FestoonError(8, "", "stopped"));
    }
}

/* Points of a row of `count`, so that few are spread over all of it and later ones fill the gaps. */
export function coarseFirst(count) {
    const order = [], seen = new Set();
    const take = (i) => {
        if (i < count && !seen.has(i)) {
            seen.add(i);
            order.push(i);
        }
    };
    let stride = 1;
    while (stride < count)
        stride *= 2;
    take(0);
    take(count - 1);
    for (; stride >= 1; stride /= 2)
        for (let i = 0; i < count; i += stride)
            take(i);
    return order;
}

export class Pool {
    constructor(module, address, threads) {
        this.module = module;
        this.address = address;
        this.threads = threads;
        this.busy = new Set();
        this.idle = [];
        this.maps = new Map(); /* by their names: {name, bytes, checksum} */
    }

    /* The measured field that a scene names, which goes with it to a worker. */
    mapOf(scene) {
        return this.maps.get(String(scene?.["magnet.file"] ?? "").split("/").at(-1));
    }

    async with(use) {
        const runner = this.idle.pop() || new Runner(this);
        this.busy.add(runner);
        try {
            return await use(runner);
        } finally {
            this.busy.delete(runner);
            if (runner.worker)
                this.idle.push(runner);
        }
    }

    run(scene, onFraction) {
        return this.with((runner) => runner.ask({ kind: "run", scene }, onFraction));
    }

    /* A run that a later one replaces. */
    async runLatest(scene, onFraction) {
        this.latest?.end();
        return this.with(async (runner) => {
            this.latest = runner;
            try {
                return await runner.ask({ kind: "run", scene }, onFraction);
            } finally {
                if (this.latest === runner)
                    this.latest = null;
            }
        });
    }

    /* Record a motion in place of the one that is being recorded; `take` gets its samples as they come. */
    async record(scene, take) {
        this.recording?.end();
        return this.with(async (runner) => {
            this.recording = runner;
            runner.onSamples = take;
            try {
                return await runner.ask({ kind: "motion", scene });
            } finally {
                runner.onSamples = null;
                if (this.recording === runner)
                    this.recording = null;
            }
        });
    }

    /* All points of an axis; `take(point, result or error)` gets each as it is done, coarse ones first. */
    async sweep(scene, axis, count, take) {
        const queue = coarseFirst(count);
        const job = { stopped: false };
        this.sweeping = job;
        const work = (runner) => (async () => {
            while (queue.length && !job.stopped) {
                const point = queue.shift();
                try {
                    const result = await runner.ask({ kind: "point", scene, axis, point });
                    if (!job.stopped)
                        take(point, result);
                } catch (error) {
                    if (error.status === 8)
                        throw error;
                    take(point, error);
                }
            }
        })();
        const lanes = Math.min(this.threads, count);
        await Promise.all(Array.from({ length: lanes }, () => this.with((runner) => {
            job.runners = [...(job.runners || []), runner];
            return work(runner);
        })));
        if (job.stopped)
            throw new FestoonError(8, "", "stopped");
    }

    stopSweep() {
        if (!this.sweeping)
            return;
        this.sweeping.stopped = true;
        for (const runner of this.sweeping.runners || [])
            if (this.busy.has(runner))
                runner.end();
        this.sweeping = null;
    }

    stop() {
        this.stopSweep();
        for (const runner of [...this.busy])
            runner.end();
    }
}
