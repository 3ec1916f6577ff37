/* core.js - the library in WebAssembly, as objects and texts of JavaScript.  Page, workers and tests use this file. */

export const STATUS = { OK: 0, BAD_INPUT: 1, NO_MEMORY: 6, INTERRUPTED: 8 };
const MOST_POINTS = 1e5;
const ROW = { PART: 1, VECTOR: 2, BEAD: 3 }; /* OF_* of lab.c: what a row behind the table belongs to */
export const STOP = { TIME: 1, EDGE: 4, LIFT_OFF: 8 }; /* FST_AT_* */

/* The columns of a row of the motion: lab.c has the same names in the same order. */
const WIDTHS = [
    ["time", 1], ["turns", 1], ["omega", 1], ["x", 1], ["y", 1], ["r", 1], ["phi", 1], ["alpha", 1], ["n", 3], ["b", 3],
    ["nLocal", 3], ["field", 1], ["angle", 1], ["slip", 2], ["slipSize", 1], ["spin", 1], ["load", 1], ["energy", 1],
    ["friction", 1], ["use", 1], ["sticks", 1], ["speed", 1], ["force", 2], ["turn", 4],
    ["z", 1], ["magnet", 1], ["touches", 1],
];
export const COLUMN = {};
let columns = 0;
for (const [name, width] of WIDTHS) {
    COLUMN[name] = columns;
    columns += width;
}
export const COLUMNS = columns;

const GROUP_NAMES = ["eps", "inertia", "h", "lambda", "kappa", "a", "b", "omega", "gravity", "plate_radius",
    "length_unit_m", "time_unit_s", "mass_kg", "field_unit_t", "lines"];
const KINDS = ["real", "integer", "choice", "text"];

/* An error of the library: `where` names a key or a time, `message` is its sentence. */
export class FestoonError extends Error {
    constructor(status, where, sentence) {
        super(sentence);
        this.name = "FestoonError";
        this.status = status;
        this.where = where;
    }
}

const number = (value) => (Number.isFinite(value) ? value : null);

/* What the C library asks of a system: to write nothing and to know no environment. */
function imports(memory, tell, take) {
    const zeros = (a, b) => {
        new DataView(memory().buffer).setUint32(a, 0, true);
        new DataView(memory().buffer).setUint32(b, 0, true);
        return 0;
    };
    const written = (file, list, count, done) => {
        const view = new DataView(memory().buffer);
        let size = 0;
        for (let i = 0; i < count; ++i)
            size += view.getUint32(list + 8 * i + 4, true);
        view.setUint32(done, size, true);
        return 0;
    };
    return {
        lab: { tell, take },
        wasi_snapshot_preview1: {
            environ_get: () => 0,
            environ_sizes_get: zeros,
            fd_close: () => 0,
            fd_seek: () => 70,
            fd_write: written,
            clock_time_get: (id, precision, at) => {
                new DataView(memory().buffer).setBigUint64(at, BigInt(Math.round(performance.now() * 1e6)), true);
                return 0;
            },
            proc_exit: (code) => {
                throw new Error(`the library ended with ${code}`);
            },
        },
    };
}

export class Core {
    /* `module` is a WebAssembly.Module; `tell`, if given, hears how far a run is and returns 1 to stop it. */
    static async open(module, tell) {
        const core = new Core();
        const heard = tell || (() => 0);
        const instance = await WebAssembly.instantiate(module, imports(() => core.c.memory, heard, (beads) => core.take(core.rows(beads))));
        core.c = instance.exports;
        core.c._initialize?.();
        core.take = () => 1;
        core.bead = core.given(core.c.lab_new());
        if (core.c.lab_columns() !== COLUMNS)
            throw new Error("lab.c and core.js name different columns");
        core.version = core.text(core.c.lab_version());
        core.resultsVersion = core.c.lab_results_version();
        core.parameters = core.readParameters();
        core.places = new Map(core.parameters.map((row, index) => [row.key, index]));
        core.results = core.readResults();
        return core;
    }

    text(at) {
        const bytes = new Uint8Array(this.c.memory.buffer);
        const from = at >>> 0;
        let end = from;
        while (bytes[end])
            ++end;
        return new TextDecoder().decode(bytes.slice(from, end));
    }

    /* An address that the library gave; 0 says that the browser gave it no more memory.  Beyond 2 GB an address is a
     * negative number to JavaScript. */
    given(at) {
        if (!at)
            throw new FestoonError(STATUS.NO_MEMORY, "", "out of memory");
        return at >>> 0;
    }

    /* Call with a text as UTF-8 in the module's memory. */
    withTexts(texts, call) {
        const places = [];
        try {
            for (const text of texts) {
                const bytes = new TextEncoder().encode(String(text).replaceAll("\0", "?"));
                const at = this.given(this.c.lab_alloc(bytes.length + 1)), memory = new Uint8Array(this.c.memory.buffer);
                places.push(at);
                memory.set(bytes, at);
                memory[at + bytes.length] = 0;
            }
            return call(...places);
        } finally {
            places.forEach((at) => this.c.lab_release(at));
        }
    }

    doubles(at, count) {
        return new Float64Array(this.c.memory.buffer, at >>> 0, count);
    }

    check(status) {
        if (status !== STATUS.OK)
            throw new FestoonError(status, this.text(this.c.lab_error(this.bead, 0)),
                this.text(this.c.lab_error(this.bead, 1)));
    }

    readParameters() {
        return Array.from({ length: this.c.lab_param_count() }, (_, i) => this.readParameter(i));
    }

    readParameter(i) {
        const [key, unit, units, names, doc, otherForm] = [0, 1, 2, 3, 4, 5].map((which) =>
            this.text(this.c.lab_param_text(i, which)));
        const [kind, initial, least, greatest] = [0, 1, 2, 3].map((which) => this.c.lab_param_number(i, which));
        return {
            key, unit, doc, otherForm, initial, least, greatest, kind: KINDS[kind], names: names ? names.split("|") : null,
            units: units ? units.split(" ") : [],
        };
    }

    /* Whether the library knows a key; those of a magnet's parts are not in `parameters`. */
    knows(key) {
        return this.withTexts([key], (text) => this.c.lab_param_find(text)) >= 0;
    }

    readResults() {
        const rows = [];
        for (let i = 0; i < this.c.lab_result_count(); ++i) {
            const [name, unit, doc] = [0, 1, 2].map((which) => this.text(this.c.lab_result_info(i, which)));
            rows.push({ name, unit, doc });
        }
        return rows;
    }

    /* ------------------------------------------------------------ parameters */

    reset() {
        this.c.lab_reset(this.bead);
    }

    set(key, value) {
        this.check(this.withTexts([key, value], (k, v) => this.c.lab_set(this.bead, k, v)));
    }

    /* The value as a scene would say it, in SI; "" where it was not given. */
    get(key) {
        return this.at(this.places.get(key));
    }

    at(index) {
        return this.text(this.c.lab_get(this.bead, index));
    }

    value(key) {
        return this.c.lab_value(this.bead, this.places.get(key));
    }

    /* All parameters are those of `scene`, an object of keys with numbers or texts, over the defaults.  Where one is bad,
     * all stay as they were. */
    setScene(scene) {
        this.c.lab_keep(this.bead);
        try {
            this.reset();
            for (const [key, value] of Object.entries(scene))
                this.set(key, value);
            this.check(this.c.lab_check(this.bead));
        } catch (error) {
            this.c.lab_undo(this.bead);
            throw error;
        }
    }

    warning() {
        return this.text(this.c.lab_warning(this.bead));
    }

    /* Keep a map, {name, bytes}, for scenes that name it.  Returns its checksum. */
    readMap({ name, bytes }) {
        const at = this.given(this.c.lab_alloc(bytes.length + 1));
        try {
            new Uint8Array(this.c.memory.buffer).set(bytes, at);
            this.check(this.withTexts([name], (text) => this.c.lab_map(this.bead, text, at, bytes.length)));
        } finally {
            this.c.lab_release(at);
        }
        return this.text(this.c.lab_map_checksum(this.bead));
    }

    /* What makes the map of the scene doubtful, or "". */
    mapDoubt() {
        return this.text(this.c.lab_map_doubt(this.bead));
    }

    /* B_z over the square about the disc of the map, `side` rows along y of as many numbers, NaN outside; and its radius. */
    mapPicture(side) {
        const all = this.doubles(this.given(this.c.lab_map_picture(this.bead, side)), side * side + 1);
        return { side, up: Array.from(all.subarray(0, side * side)), radius: all[side * side] };
    }

    groups() {
        const at = this.c.lab_groups(this.bead);
        if (!at)
            throw new FestoonError(STATUS.BAD_INPUT, ...[0, 1].map((which) => this.text(this.c.lab_error(this.bead, which))));
        const values = this.doubles(at, GROUP_NAMES.length);
        return Object.fromEntries(GROUP_NAMES.map((name, i) => [name, number(values[i])]));
    }

    /* The value of a row, as `festoon run --json` has it; null where it was not given. */
    plain(index, kind) {
        const text = this.at(index);
        return text === "" ? null : kind === "choice" || kind === "text" ? text : number(this.c.lab_value(this.bead, index));
    }

    scene() {
        const scene = Object.fromEntries(this.parameters.map((row, i) => [row.key, this.plain(i, row.kind)])), parts = this.parts();
        if (parts.length)
            scene["magnet.parts"] = parts;
        for (const { key, kind, index } of this.rowsOf(ROW.VECTOR))
            scene[key] = this.plain(index, kind);
        return scene;
    }

    /* The rows behind the table that belong to parts of the magnet, or to vectors and coils. */
    rowsOf(what) {
        const rows = [];
        for (let index = this.parameters.length; index < this.c.lab_row_count(this.bead); ++index)
            if (this.c.lab_row_of(this.bead, index) === what)
                rows.push({ ...this.readParameter(index), index });
        return rows;
    }

    /* The parts of a real magnet, as `festoon run --json` lists them, in SI units. */
    parts() {
        const parts = [];
        for (const { key, kind, index } of this.rowsOf(ROW.PART)) {
            const value = this.plain(index, kind), name = /\.(\w+)[^.]*$/.exec(key)[1];
            if (name === "kind")
                parts.push({ kind: value });
            else if (kind === "choice")
                parts.at(-1)[name] = value;
            else if (value !== null) // the kind of part has such a number
                (parts.at(-1)[name] ||= []).push(value);
        }
        return parts;
    }

    /* ------------------------------------------------------------ runs */

    /* What `festoon run --json` prints for these parameters; of several beads without the list of events. */
    run() {
        this.check(this.c.lab_run(this.bead));
        if (!this.isRecorded())
            return this.result();
        return this.isList() ? this.beadsResult() : this.worldResult();
    }

    /* Whether the motion is that of several beads or of one in a world, which is recorded as a whole; and of a list. */
    isRecorded() {
        return this.c.lab_is_recorded(this.bead) !== 0;
    }

    isList() {
        return this.rowsOf(ROW.BEAD).length > 0;
    }

    radii() {
        return Array.from({ length: this.c.lab_bead_count(this.bead) }, (_, i) => this.c.lab_radius(this.bead, i));
    }

    /* Record the motion: `take` gets rows, one for each bead, of every sample, valid until it returns, and returns whether
     * the recording ends there. */
    record(take) {
        this.c.lab_forget(this.bead);
        this.take = (rows) => (take(rows) ? 1 : 0);
        const status = this.c.lab_record(this.bead);
        if (status !== STATUS.INTERRUPTED)
            this.check(status);
    }

    /* The same of samples from a file, each a time (1/gamma), turns of the magnet and twelve numbers of each bead. */
    replay(samples, count, take) {
        this.take = (rows) => (take(rows) ? 1 : 0);
        const at = this.given(this.c.lab_alloc(8 * samples.length));
        try {
            this.doubles(at, samples.length).set(samples);
            this.check(this.c.lab_replay(this.bead, at, count));
            this.c.lab_forget(this.bead); /* not before: a motion goes on where the samples are refused */
        } finally {
            this.c.lab_release(at);
        }
    }

    worldResult() {
        const run = this.result(), frame = this.text(this.c.lab_world_frame(this.bead));
        const numbers = Array.from(this.doubles(this.c.lab_world_numbers(this.bead), 40), number);
        return {
            ...run, frame, final_time: numbers[0], final_lab: numbers.slice(1, 13), final_lab_si: numbers.slice(13, 25),
            final_state: numbers.slice(25, 37), mean_height: numbers[37], mean_medium_power: numbers[38], mean_velocity: numbers[39],
        };
    }

    beadsResult() {
        const text = (which) => this.text(this.c.lab_beads_text(this.bead, which));
        const all = this.doubles(this.c.lab_beads_numbers(this.bead), 1000), first = Array.from(all.subarray(0, 11), number);
        let at = 11;
        const next = (count) => Array.from(all.subarray(at, (at += count)), number);
        const counts = {};
        for (let i = 0, name; (name = this.text(this.c.lab_event_name(i))) !== ""; ++i)
            [counts[name]] = next(1);
        const beads = Array.from({ length: first[0] }, (_, i) => {
            const [mean_r, mean_alpha_dot, mean_load_weights, ejected_at] = next(4);
            return { regime: text(3 + i), mean_r, mean_alpha_dot, mean_load_weights, ejected_at, final_state: next(12) };
        });
        const groups = Array.from({ length: first[1] }, (_, i) => {
            const [count, mean_r, centre_rate, axis_rate] = next(4);
            return { kind: text(20 + i), members: next(count), mean_r, centre_rate, axis_rate };
        });
        const contacts = Array.from({ length: first[2] }, () => {
            const [a, b, force] = next(3);
            return { a, b: b < 0 ? null : b, force };
        });
        const [drive, plate, pair, impacts, energy_residual, restitution] = first.slice(5);
        const scales = this.groups();
        return {
            sentence: text(0), outcome: text(1), reason: text(2) || null, omega: first[3], frequency_hz: (first[3] * this.value("friction.gamma")) / (2 * Math.PI),
            periods: first[4], beads, groups, contacts, powers: { drive, plate, pair, impacts }, energy_residual, restitution, counts, scales,
            version: this.version,
        };
    }

    result() {
        const [regime, reason, symmetry, dynamics] = [0, 1, 2, 3].map((which) =>
            this.text(this.c.lab_result_text(this.bead, which)) || null);
        const scene = this.scene();
        const run = { regime, reason, symmetry, dynamics };
        this.results.forEach((row, i) => {
            run[row.name] = number(this.c.lab_result(this.bead, i));
        });
        const rest = Array.from(this.doubles(this.c.lab_result_rest(this.bead), 15));
        run.never_slips = rest[0] < 0 ? null : rest[0] !== 0;
        [run.returns, run.rhs_calls, run.steps_accepted, run.steps_rejected] = rest.slice(1, 5);
        run.final_state = rest.slice(5).map(number);
        run.groups = this.groups();
        run.scene = scene;
        run.version = this.version;
        return run;
    }

    /* The values of a grid along one axis, written as for `festoon sweep --over`. */
    grid(axis) {
        const points = this.withTexts([axis], (text) => this.c.lab_grid(this.bead, text));
        if (points < 0)
            this.check(-points);
        if (points > MOST_POINTS)
            throw new FestoonError(STATUS.BAD_INPUT, "sweep", `${points} points are more than the ${MOST_POINTS} of a page; use festoon sweep`);
        return Array.from({ length: points }, (_, i) => this.c.lab_grid_value(this.bead, i));
    }

    takePoint(point) {
        this.check(this.c.lab_grid_take(this.bead, point));
    }

    /* ------------------------------------------------------------ the motion that is shown */

    start(ramp = 0) {
        this.check(this.c.lab_start(this.bead, ramp));
        return this.rows(1);
    }

    change(ramp = 0) {
        this.check(this.c.lab_change(this.bead, ramp));
    }

    rows(count) {
        return this.doubles(this.c.lab_rows(this.bead), count * COLUMNS);
    }

    /* Go on for `seconds` of the bead's time, in `count` rows.  The rows are valid until the next call. */
    go(seconds, count) {
        const done = this.c.lab_go(this.bead, seconds, count);
        if (done < 0)
            this.check(-done);
        return { count: done, stop: this.c.lab_stop(this.bead), rows: this.rows(done) };
    }

    field(x, y) {
        return Array.from(this.doubles(this.given(this.c.lab_field(this.bead, x, y)), 3));
    }
}
