/* page.js - the page: a bead in motion, or several, what is shown of it, and what people do with it. */
import { CAMERAS, Camera } from "./camera.js";
import { ARROWS, BEADS } from "./colours.js";
import { sentence } from "./controls.js";
import { COLUMN, COLUMNS, STOP } from "./core.js";
import { listenDrags } from "./drag.js";
import { bodiesOf, hullOf, withMap, withoutMap } from "./magnet.js";
import { Pace } from "./pace.js";
import { Recording } from "./recording.js";
import { whole, write } from "./said.js";
import { PRESETS } from "./scenes.js";
import { fitted, readAddress, takeGood, writeAddress } from "./state.js";
import { languageOf, say, speak, T } from "./texts.js";
import { QUANTITIES, SPACING, Trail, unitsOf } from "./trail.js";
import { recordingOf } from "./trajectory.js";
import { View2D } from "./view2d.js";
import { View3D } from "./view3d.js";

const ROOM = 6000, RAMP_SECONDS = 5, RUN_DELAY = 350, TURNS = 7, STRIP = 30; /* pixels of the picture that lie under #live */
const SWING = 2, ABOVE = 3.4; /* room of one that floats, in its radii: it swings, and the arrow of its moment is 3.2 long */
/* What a motion on the page may take, so that a scene from outside leaves its buttons alive: ms of a frame, ms of the
 * turns that are not shown; rows, or seconds of the bead, between two looks at the clock. */
const FRAME_MS = 60, SETTLE_MS = 4000, PIECE_ROWS = 16, PIECE_SECONDS = 0.05, MOST_ROWS = 4000, ROWS_A_TURN = 2 / SPACING;
export const SLOWS = [1, 1.5, 2, 3, 4, 5, 7, 10, 13, 16, 20, 25, 30, 40, 50, 60, 70, 80, 100, 120, 140, 160, 180, 200];
const $ = (id) => document.getElementById(id);

export class Lab {
    constructor(core, pool) {
        this.core = core;
        this.pool = pool;
        this.known = (key) => core.knows(key);
        this.scene = {};
        this.settings = { slow: 20, colour: "nz", turns: TURNS, arrows: new Set(), ramp: null, settle: 0, language: null };
        this.trail = new Trail(ROOM);
        this.camera = new Camera();
        this.trails = [this.trail]; /* of each bead; `trail` is that of the first */
        this.row = new Float64Array(COLUMNS);
        this.rows = [this.row];
        this.recording = null; /* of several beads, or of one in a world */
        this.playing = false;
        this.left = STOP.TIME;
        this.pace = new Pace((now) => this.frame(now));
    }

    /* ------------------------------------------------------------ the view */

    openView() {
        const solid = $("view"), plain = solid.cloneNode();
        for (const canvas of [solid, plain]) {
            listenDrags(canvas, this);
            this.camera.listen(canvas, () => this.wake());
        }
        try {
            const deep = (this.deep = new View3D(solid, ROOM)); /* kept: off the page, its canvas would be collected as garbage */
            solid.addEventListener("webglcontextlost", () => {
                this.showThrough(new View2D(plain));
                this.tell(T.lostWebgl);
            });
            solid.addEventListener("webglcontextrestored", () => {
                this.showThrough(deep);
                this.tell("");
            });
            this.showThrough(deep);
        } catch {
            this.showThrough(new View2D(plain));
        }
        new ResizeObserver(() => this.resize()).observe($("view-box"));
    }

    /* The picture is that of `view` from now on. */
    showThrough(view) {
        const there = $("view"), focused = there === document.activeElement;
        if (there !== view.canvas)
            there.replaceWith(view.canvas);
        if (focused)
            view.canvas.focus();
        this.view = view;
        view.canvas.setAttribute("aria-label", T.viewLabel);
        this.camera.flat = view instanceof View2D;
        if (this.units) {
            this.furnish();
            this.showTrack(this.track);
        }
        this.panels.showView();
        this.resize();
    }

    resize() {
        const box = $("view-box");
        this.camera.strip = STRIP / Math.max(box.clientHeight, 4 * STRIP);
        this.view.resize(box.clientWidth, box.clientHeight, window.devicePixelRatio || 1);
        this.draw(); /* at once: the new size has emptied the canvas */
    }

    /* Lines of places, one of each bead of a track, or null. */
    showTrack(tracks) {
        this.track = tracks;
        this.view.showTrack(tracks ?? []);
        this.wake();
    }

    furnish() {
        const { core } = this, groups = core.groups(), magnetic = core.field(0.9, 0), l = groups.length_unit_m;
        this.units = unitsOf(groups);
        this.groups = groups;
        const north = Math.sign(core.field(1, 0)[2]) || 1, waveform = core.get("drive.waveform"), wave = waveform === "wave";
        const shape = core.get("magnet.shape"), real = shape === "parts", radii = this.recording ? core.radii() : [groups.eps];
        const bodies = this.bodies = shape === "grid" ? [] : real || !wave ? bodiesOf(groups, north, core.parts(), core.value("magnet.depth"), real) : [];
        const field = Math.hypot(...(this.recording ? this.row.subarray(COLUMN.b, COLUMN.b + 3) : magnetic)) || 1;
        this.view.furnish({
            map: shape === "grid" && !wave ? core.mapPicture(64) : null,
            eps: groups.eps, radii, plate: core.get("plate.shape"), bowl: core.value("plate.bowl_radius") / l,
            plateRadius: groups.plate_radius, ring: 10 / this.units.mm, fieldScale: field, bodies,
            wave: wave ? { length: core.value("wave.length") / l, sign: core.value("wave.ratio") > 1 ? -1 : 1 } : null,
            follows: wave || waveform === "carried", hull: this.hullOf(bodies, radii, wave), colours: radii.length > 1 ? BEADS : null,
        });
    }

    /* What is to be seen: the magnet and where beads begin; a wave has no middle, so there it is what is about the bead. */
    hullOf(bodies, radii, wave) {
        const most = Math.max(...radii);
        if (!this.recording)
            return hullOf(bodies, Math.max(1.2, 1.25 * this.core.value("start.r")), this.groups.eps);
        if (wave)
            return [[14 * most, 0]];
        const far = Math.max(...this.rows.map((row) => Math.hypot(row[COLUMN.x], row[COLUMN.y]))), heights = this.rows.map((row) => row[COLUMN.z]);
        if (this.core.get("plate.shape") === "none")
            return hullOf(bodies, far + most, most, Math.min(...heights) - SWING * most, Math.max(...heights) + ABOVE * most);
        return hullOf(bodies, Math.max(1.2, 1.25 * far), most);
    }

    /* The picture is no longer what is the case: a frame is due. */
    wake() {
        this.pace.wake();
    }

    draw() {
        if (!this.units)
            return;
        this.range = this.trail.range(QUANTITIES[this.settings.colour]);
        this.view.draw({ rows: this.rows, trails: this.trails, range: this.range, camera: this.camera, arrows: this.settings.arrows });
    }

    /* All words in the language that was chosen, else in one of the browser's; nothing else changes. */
    speak() {
        this.language = this.settings.language ?? languageOf(navigator.languages);
        speak(this.language);
        this.tell("");
        this.controls.build($("main-controls"), $("all-controls"));
        this.panels.build();
        this.files.build();
        this.lesson.build();
        this.namePlay();
        if (!this.view)
            return;
        this.controls.show(null, this.scene);
        this.panels.showView();
        this.wake();
    }

    /* ------------------------------------------------------------ scene and motion */

    /* A line at the top: news, or what went wrong. */
    tell(text, bad = false) {
        write($("notice"), text);
        $("notice").classList.toggle("bad", bad);
    }

    /* Take a scene; on an error the old one stays and the sentence is returned.  The samples of a trajectory of this scene
     * take the place of what would be computed, until the scene changes. */
    takeScene(scene, trajectory = null) {
        try {
            this.core.setScene(scene);
        } catch (error) {
            if (scene["magnet.file"] && !this.pool.mapOf(scene))
                this.awaited = scene; /* until its map is dropped */
            return sentence(error);
        }
        try {
            this.replayed = trajectory && recordingOf(trajectory, this.core);
        } catch (error) {
            this.core.setScene(this.scene);
            return sentence(error);
        }
        this.scene = { ...scene };
        return null;
    }

    /* One parameter changes; an empty text brings its default back. */
    change(key, text) {
        const scene = { ...this.scene }, info = this.core.parameters[this.core.places.get(key)];
        if (this.ramping) {
            scene["drive.frequency"] = `${this.frequency().toPrecision(6)} Hz`;
            this.ramping = null;
        }
        delete scene[key];
        if (text !== "") {
            if (info.otherForm)
                delete scene[info.otherForm];
            scene[key] = text;
        }
        if (key === "magnet.shape")
            return this.changeTo(text === "grid" ? withMap(scene, [...this.pool.maps.values()].at(-1)) : withoutMap(scene), key);
        return this.changeTo(info.kind === "choice" ? fitted(scene, key, (some) => this.core.setScene(some)) : scene, key);
    }

    /* A scene from an address whose map nobody has dropped yet waits for it; until then it goes without. */
    withoutAway(scene, wrong) {
        if (!scene["magnet.file"] || this.pool.mapOf(scene))
            return scene;
        this.awaited = scene;
        try {
            this.core.setScene(scene);
        } catch (error) {
            if (error.where === "magnet.file")
                wrong.push(whole(sentence(error)));
        }
        const { "magnet.shape": shape, ...rest } = withoutMap(scene);
        return rest;
    }

    /* Keep a measured field for scenes that name it. */
    takeMap(name, bytes) {
        const map = { name, bytes, checksum: this.core.readMap({ name, bytes }) };
        this.pool.maps.delete(name); /* the latest is the last */
        this.pool.maps.set(name, map);
        return map;
    }

    /* Another scene, which differs by one key, or by the places of a magnet's parts; the motion goes on where it can. */
    changeTo(scene, key) {
        const wrong = this.takeScene(scene);
        if (wrong)
            return wrong;
        this.controls.texts = this.scene;
        if (key === "drive.frequency" || key === "drive.omega")
            this.settings.ramp = null;
        if (key === "magnet.shape")
            this.panels.showView();
        if (key.startsWith("start.") || this.recording || this.core.isRecorded())
            this.begin();
        else
            this.goOn(0);
        this.changed();
        return null;
    }

    goOn(ramp) {
        try {
            this.core.change(ramp);
            this.furnish();
        } catch (error) {
            this.tell(sentence(error), true);
        }
        this.wake();
    }

    /* Begin at start.*, after `settle` turns that are not shown. */
    begin() {
        try {
            this.ramping = null;
            this.pace.reset();
            this.left = STOP.TIME;
            this.tell("");
            if (this.replayed || this.core.isRecorded()) {
                this.beginRecording();
                return;
            }
            this.recording = null;
            this.takeRows([Float64Array.from(this.core.start(0))]);
            this.clearTrails();
            this.furnish();
            if (this.settings.settle > 0) {
                const shown = this.hideTrail ? 0 : Math.min(this.settings.turns, this.settings.settle / 2);
                if (this.settleFor((this.settings.settle - shown) / this.driveFrequency()) && shown)
                    this.advance(shown / this.driveFrequency(), SETTLE_MS);
            }
            if (this.settings.ramp)
                this.beginRamp();
        } catch (error) {
            this.tell(sentence(error), true);
        }
        this.wake();
    }

    takeRows(rows) {
        this.rows = rows;
        this.row = rows[0];
    }

    clearTrails() {
        while (this.trails.length < this.rows.length)
            this.trails.push(new Trail(ROOM));
        this.trails.length = this.rows.length;
        this.trails.forEach((trail) => trail.clear());
    }

    /* The first sample is computed here, the others come from a worker. */
    beginRecording() {
        const recording = (this.recording = new Recording());
        if (this.replayed)
            recording.add(this.replayed);
        else
            this.core.record((rows) => {
                recording.add([Float64Array.from(rows)]);
                return true;
            });
        this.takeRows(recording.rows(0).map((row) => row.slice()));
        this.clearTrails();
        this.furnish();
        this.wake();
        recording.done = this.replayed !== null;
        if (recording.done)
            return;
        let first = true;
        this.pool.record({ ...this.scene }, (samples) => {
            recording.add(first ? samples.slice(1) : samples);
            first = false;
        }).catch((error) => {
            if (error.status !== 8 && recording === this.recording)
                this.tell(sentence(error), true);
        }).finally(() => {
            recording.done = true;
        });
    }

    /* Go on by what is recorded.  Returns the seconds that are done. */
    advanceRecorded(seconds) {
        const { recording } = this, before = this.row[COLUMN.time], quantity = QUANTITIES[this.settings.colour];
        const rows = recording.go(Math.min(before + seconds, recording.end), (passed) =>
            passed.forEach((row, i) => this.trails[i].take(row, quantity, this.units, this.settings.turns)));
        this.takeRows(rows);
        if (recording.done && this.row[COLUMN.time] >= recording.end) {
            this.tell(T.recordedEnd);
            this.play(false);
        }
        return this.row[COLUMN.time] - before;
    }

    /* Show another time of what is recorded, with the trail that leads there. */
    seek(time) {
        const { recording } = this, first = time - this.settings.turns / this.driveFrequency();
        recording.at = Math.max(0, recording.samples.findLastIndex((sample) => sample[COLUMN.time] <= first));
        this.clearTrails();
        this.takeRows(recording.rows(recording.at).map((row) => row.slice()));
        this.advanceRecorded(time - this.row[COLUMN.time]);
        this.wake();
    }

    atRecordedEnd() {
        return this.recording?.done && this.row[COLUMN.time] >= this.recording.end;
    }

    /* Go on without a trail.  Returns whether all of it was done. */
    settleFor(seconds) {
        const begun = performance.now(), pieces = Math.max(1, Math.ceil(seconds / PIECE_SECONDS));
        for (let i = 0; i < pieces && this.left === STOP.TIME; ++i) {
            if (performance.now() - begun > SETTLE_MS) {
                this.tell(T.settledLess);
                return false;
            }
            const done = this.core.go(seconds / pieces, 1);
            this.row.set(done.rows.subarray(0, COLUMNS));
            this.leave(done.stop);
        }
        return true;
    }

    driveFrequency() {
        return this.groups.omega / (2 * Math.PI * this.groups.time_unit_s);
    }

    frequency() {
        return this.row[COLUMN.omega] / (2 * Math.PI * this.groups.time_unit_s);
    }

    beginRamp() {
        const to = this.settings.ramp, from = this.driveFrequency();
        if (!(to > 0) || to === from)
            return;
        const unit = this.groups.time_unit_s;
        this.ramping = { to, up: to > from };
        this.goOn((2 * Math.PI * (to - from) * unit) / (RAMP_SECONDS / unit));
    }

    leave(stop) {
        this.left = stop;
        if (stop !== STOP.TIME) {
            this.tell(stop === STOP.EDGE ? T.left.edge : T.left.lift);
            this.play(false);
        }
    }

    /* Go on by `seconds`, or by what `most` milliseconds of work are enough for.  Returns the seconds that are done. */
    advance(seconds, most = Infinity) {
        if (!this.units || this.left !== STOP.TIME)
            return 0;
        if (this.recording)
            return this.advanceRecorded(seconds);
        const before = this.row[COLUMN.time];
        const count = Math.max(1, Math.min(MOST_ROWS, Math.ceil(seconds * this.frequency() * ROWS_A_TURN)));
        const begun = performance.now();
        try {
            for (let from = 0; from < count && this.left === STOP.TIME && performance.now() - begun < most; from += PIECE_ROWS) {
                const rows = Math.min(PIECE_ROWS, count - from);
                this.take(this.core.go((seconds * rows) / count, rows));
            }
        } catch (error) {
            this.tell(sentence(error), true);
            this.play(false);
        }
        if (this.ramping && (this.ramping.up ? this.frequency() >= this.ramping.to : this.frequency() <= this.ramping.to)) {
            const to = this.ramping.to;
            this.ramping = null;
            this.change("drive.frequency", `${to} Hz`);
            this.controls.show(null, this.scene);
        }
        return this.row[COLUMN.time] - before;
    }

    take(done) {
        const quantity = QUANTITIES[this.settings.colour];
        for (let i = 0; i < done.count; ++i)
            this.trail.take(done.rows.subarray(i * COLUMNS, (i + 1) * COLUMNS), quantity, this.units, this.settings.turns);
        this.row.set(done.rows.subarray((done.count - 1) * COLUMNS, done.count * COLUMNS));
        this.leave(done.stop);
    }

    frame(now) {
        if (this.playing)
            this.pace.go(now, this.settings.slow, (seconds) => this.advance(seconds, FRAME_MS));
        this.draw();
        this.panels.frame(this.playing ? now : Infinity);
        if (this.playing)
            this.wake();
    }

    play(on) {
        if (on && this.atRecordedEnd())
            this.begin();
        this.playing = on && Boolean(this.units) && this.left === STOP.TIME;
        on = this.playing;
        this.pace.reset();
        this.wake();
        this.namePlay();
    }

    namePlay() {
        $("play").textContent = this.playing ? T.pause : T.play;
        $("play").setAttribute("aria-pressed", String(this.playing));
    }

    step() {
        this.play(false);
        if (this.units)
            this.advance(1 / (64 * this.frequency()));
    }

    restart() {
        this.settings.settle = 0;
        this.begin();
        this.remember();
    }

    /* ------------------------------------------------------------ what follows from a change */

    changed() {
        this.remember();
        clearTimeout(this.timer);
        this.waiting = true; /* for what a run says of the parameters */
        $("regime").textContent = T.wait;
        this.timer = setTimeout(() => this.runNow(), RUN_DELAY);
        this.panels.markPreset();
        this.panels.forgetSweep(JSON.stringify({ ...this.scene, "drive.frequency": 0, "drive.omega": 0 }));
    }

    async runNow() {
        try {
            const result = await this.pool.runLatest({ ...this.scene }, (share) => {
                $("regime").textContent = say(T.waitShare, { n: Math.floor(100 * share) });
            });
            this.waiting = false;
            this.panels.showRun(result);
        } catch (error) {
            if (error.status !== 8)
                write($("regime"), sentence(error));
        }
    }

    viewWords() {
        const s = this.settings, words = { "ui.slow": String(s.slow), "ui.camera": this.camera.chosen };
        if (s.colour !== "nz")
            words["ui.colour"] = s.colour;
        if (s.turns !== TURNS)
            words["ui.trail"] = String(s.turns);
        if (s.arrows.size)
            words["ui.arrows"] = [...s.arrows].join();
        if (s.ramp)
            words["ui.ramp"] = String(s.ramp);
        if (s.settle)
            words["ui.settle"] = String(s.settle);
        if (this.lesson.at >= 0)
            words["ui.step"] = String(this.lesson.at + 1);
        if (s.language)
            words["ui.lang"] = s.language;
        return words;
    }

    remember() {
        try {
            history.replaceState(null, "", writeAddress(this.scene, this.viewWords()));
        } catch {
            /* a page within another one, as in a notebook, has no address of its own */
        }
    }

    /* Take settings of the view, as words of an address. */
    takeView(view) {
        const s = this.settings, near = (list, value) => list.reduce((a, b) => (Math.abs(b - value) < Math.abs(a - value) ? b : a));
        const number = (key) => (Number.isFinite(Number(view[key])) ? Number(view[key]) : 0);
        if ("ui.slow" in view)
            s.slow = near(SLOWS, number("ui.slow"));
        if (CAMERAS.includes(view["ui.camera"]) && view["ui.camera"] !== this.camera.chosen)
            this.camera.choose(view["ui.camera"]);
        s.colour = Object.hasOwn(QUANTITIES, view["ui.colour"] ?? "") ? view["ui.colour"] : "nz";
        s.turns = Math.max(1, Math.min(60, number("ui.trail") || TURNS));
        s.arrows = new Set((view["ui.arrows"] || "").split(",").filter((name) => Object.hasOwn(ARROWS, name)));
        s.ramp = number("ui.ramp") > 0 ? number("ui.ramp") : null;
        s.settle = Math.max(0, Math.min(1000, number("ui.settle")));
        this.panels.showView();
    }

    /* A whole state: scene and view, and perhaps a trajectory of the scene to be played.  Where they are refused nothing
     * changes, and the sentence is returned. */
    open({ scene, view }, trajectory = null) {
        const wrong = this.takeScene(scene, trajectory);
        if (wrong) {
            this.tell(wrong, true);
            return wrong;
        }
        this.showTrack(null); /* it was of another scene */
        this.takeView(view);
        this.begin();
        this.controls.show(null, this.scene);
        this.changed();
        return null;
    }

    /* The state that the address tells, of which what is bad or unknown is named and left out.  The Back and Forward of
     * the browser come here too. */
    openAddress() {
        const { scene, view: { "ui.lang": language, ...view }, unknown } = readAddress(location.hash, this.known), step = Number(view["ui.step"]);
        this.settings.language = language ?? this.settings.language;
        if (language && language !== this.language)
            this.speak();
        if (step >= 1) {
            this.lesson.open(step - 1);
            return;
        }
        this.lesson.close();
        if (!Object.keys(scene).length && !Object.keys(view).length && !unknown.length) {
            this.openPreset(PRESETS[1]);
        } else {
            const wrong = [], good = takeGood(this.withoutAway(scene, wrong), (some) => this.core.setScene(some)), found = good.errors.length + wrong.length;
            wrong.push(...good.errors.map((error) => whole(sentence(error))));
            this.open({ scene: good.scene, view });
            if (unknown.length)
                wrong.push(say(T.unknown, { words: unknown.join(", ") }));
            if (wrong.length)
                this.tell(`${wrong.join(" ")} ${T.restTaken}`, found > 0);
        }
        this.play(!window.matchMedia("(prefers-reduced-motion: reduce)").matches);
    }

    /* Let `act` put another scene in the place of this one, to which Back of the browser then returns. */
    replace(act) {
        const before = location.hash;
        act();
        const after = location.hash;
        if (!before || before === after)
            return;
        try {
            history.replaceState(null, "", before);
            history.pushState(null, "", after);
        } catch {
            /* a page within another one has no history of its own */
        }
    }

    openPreset(preset) {
        this.hideTrail = false;
        this.open({ scene: preset.scene, view: { "ui.settle": String(preset.settle ?? 0), ...preset.view } });
        this.play(true);
    }
}
