/* panels.js - what stands around the view: transport, cameras, presets, plots, numbers. */
import { isOneOfTwo, openBeside } from "./beside.js";
import { CAMERAS } from "./camera.js";
import { ARROWS, BEADS, GROUND } from "./colours.js";
import { element, sentence } from "./controls.js";
import { COLUMN } from "./core.js";
import { canDrag } from "./drag.js";
import { factorTold } from "./pace.js";
import { Plot, rangeOf, regimeColour } from "./plots.js";
import { inUnits, told, whole, write } from "./said.js";
import { PRESETS } from "./scenes.js";
import { LANGUAGES, plainOf, say, shown, T } from "./texts.js";
import { PALETTE, QUANTITIES } from "./trail.js";

const $ = (id) => document.getElementById(id);
const DEGREES = 180 / Math.PI, PLOT_EVERY = 120, BLUE = "#2f7fd0", ORANGE = "#d2622a", GREEN = "#2a9d74";
const digits = (value, n = 4) => (value === null || value === undefined || !Number.isFinite(value) ? "–" : shown(Number((Math.abs(value) < 5e-4 ? 0 : value).toPrecision(n))));

const percent = (share) => say(T.percent, { n: digits(100 * share, 3) });

/* What a run of one bead says: the regime with its measures, which are texts. */
export function regimeSentence(regime, measures) {
    const { regimes } = T, name = !Object.hasOwn(regimes, regime) || regime === "undecided" ? (measures.oneOff ? "oneOff" : measures.free ? "free" : "undecided")
        : regime === "counter-rotating" && measures.festoons !== null ? "festoons" : regime;
    return say(regimes[name], measures);
}

export class Panels {
    constructor(lab, slows) {
        this.lab = lab;
        this.slows = slows;
        this.plot = "phi";
        this.points = new Map();
        this.drawn = -Infinity;
    }

    /* What is there in all languages, once. */
    listen() {
        const { lab } = this;
        $("stamp").textContent = `festoon ${lab.core.version}, results version ${lab.core.resultsVersion}`;
        $("language").append(...Object.entries(LANGUAGES).map(([value, name]) => element("option", { value, lang: value }, name)));
        $("language").addEventListener("change", () => {
            lab.settings.language = $("language").value;
            lab.speak();
            lab.remember();
        });
        $("play").addEventListener("click", () => lab.play(!lab.playing));
        $("step").addEventListener("click", () => lab.step());
        $("restart").addEventListener("click", () => lab.restart());
        $("time").addEventListener("input", () => lab.seek(Number($("time").value)));
        document.querySelector("header").hidden = isOneOfTwo();
        $("lesson-open").addEventListener("click", () => lab.lesson.toggle());
        $("slow").max = String(this.slows.length - 1);
        $("slow").addEventListener("input", () => {
            lab.settings.slow = this.slows[Number($("slow").value)];
            lab.pace.reset();
            this.showView();
            lab.remember();
        });
        this.buildScreen();
        this.buildPaper();
        this.canvas = new Plot($("plot"));
        $("sweep-form").addEventListener("submit", (event) => {
            event.preventDefault();
            if (this.sweeping)
                this.lab.pool.stopSweep();
            else
                this.sweep();
        });
        new ResizeObserver(() => this.frame(Infinity)).observe($("plot-box"));
        new ResizeObserver(() => document.documentElement.style.setProperty("--news", `${Math.ceil($("notice").getBoundingClientRect().height)}px`)).observe($("notice"));
    }

    /* All words, in the language that is spoken now. */
    build() {
        const { lab } = this;
        document.documentElement.lang = T.lang;
        document.title = `festoon lab: ${T.subtitle}`;
        $("language").value = lab.language;
        for (const [id, text] of Object.entries({
            subtitle: T.subtitle, step: T.step, restart: T.restart, "slow-name": T.slow, "presets-name": T.presets, "main-name": T.main,
            "view-name": T.view, "all-name": T.parameters, "files-name": T.files, keys: T.keys, "why-name": T.details,
        }))
            $(id).textContent = text;
        for (const [id, text] of Object.entries({ language: T.language, slow: T.slow, cameras: T.view, stage: T.stage, controls: T.controls, view: T.viewLabel, time: T.recordedTime }))
            $(id).setAttribute("aria-label", text);
        $("cameras").replaceChildren();
        $("presets").replaceChildren();
        for (const name of CAMERAS) {
            const button = element("button", { type: "button", "data-camera": name }, T.cameras[name]);
            button.addEventListener("click", () => this.chooseCamera(name));
            $("cameras").append(button);
        }
        for (const preset of PRESETS) {
            const button = element("button", { type: "button", "data-preset": preset.id }, T.presetNames[preset.id]);
            button.addEventListener("click", () => {
                lab.replace(() => {
                    lab.lesson.close();
                    lab.openPreset(preset);
                });
            });
            $("presets").append(button);
        }
        this.markPreset();
        this.buildView();
        this.buildPlots();
        this.nameScreen();
        if (lab.waiting)
            $("regime").textContent = T.wait;
        else if (this.result)
            this.showRun(this.result);
    }

    /* Which experiment is open, as long as nothing of it is changed. */
    markPreset() {
        const open = JSON.stringify(this.lab.scene);
        [...$("presets").children].forEach((button, i) => button.setAttribute("aria-pressed", String(JSON.stringify(PRESETS[i].scene) === open)));
    }

    /* The picture with its controls on the whole screen, where the browser lets a page have it. */
    buildScreen() {
        $("screen").hidden = !document.fullscreenEnabled;
        $("screen").addEventListener("click", () => this.fillScreen());
        document.addEventListener("fullscreenchange", () => this.nameScreen());
    }

    nameScreen() {
        $("screen").textContent = document.fullscreenElement ? T.screenLeave : T.screen;
    }

    fillScreen() {
        if (document.fullscreenElement)
            document.exitFullscreen();
        else if (document.fullscreenEnabled)
            $("theatre").requestFullscreen().catch((error) => this.lab.tell(sentence(error), true));
    }

    /* What is printed: the picture and the numbers as they stand, dark on white, and of which bead they are. */
    buildPaper() {
        const set = (paper) => {
            this.canvas.paper = paper;
            this.lab.view.lieOn(paper ? GROUND.paper : GROUND.screen);
            this.lab.draw();
            this.frame(Infinity);
        };
        window.addEventListener("beforeprint", () => {
            const given = Object.entries(this.lab.scene).map(([key, value]) => say(T.pair, { name: this.lab.controls.rows.get(key)?.label.textContent ?? key, value: T.choices[key]?.[value] || shown(value) }));
            $("paper").textContent = `${given.length ? say(T.paper, { given: given.join("; ") }) : T.paperDefault} ${$("stamp").textContent}.`;
            set(true);
        });
        window.addEventListener("afterprint", () => set(false));
    }

    buildView() {
        const { lab } = this, s = lab.settings;
        this.colour = element("select", { id: "colour" }, ...Object.keys(QUANTITIES).map((name) => element("option", { value: name }, T.quantities[name])));
        this.colour.addEventListener("change", () => {
            s.colour = this.colour.value;
            lab.trails.forEach((trail) => trail.colourBy(QUANTITIES[s.colour], lab.units));
            this.showView();
            lab.remember();
            lab.wake();
        });
        this.turns = element("input", { id: "turns", type: "range", min: "1", max: "60", step: "1" });
        this.turns.addEventListener("input", () => {
            s.turns = Number(this.turns.value);
            lab.remember();
        });
        const arrows = element("fieldset", {}, element("legend", {}, T.arrows));
        this.arrowBoxes = Object.keys(ARROWS).map((name) => {
            const box = element("input", { type: "checkbox", id: `arrow-${name}`, value: name });
            box.addEventListener("change", () => {
                if (box.checked)
                    s.arrows.add(name);
                else
                    s.arrows.delete(name);
                this.showView();
                lab.remember();
                lab.wake();
            });
            arrows.append(element("label", {}, box, ` ${T.arrowNames[name]}`));
            return box;
        });
        $("view-controls").replaceChildren(element("div", { class: "row" }, element("label", { for: "colour" }, T.colour), this.colour),
            element("div", { class: "row" }, element("label", { for: "turns" }, T.trailTurns), this.turns), arrows,
            ...(isOneOfTwo() ? [] : [this.besideButton()]));
    }

    besideButton() {
        const button = element("button", { type: "button", id: "beside-open" }, T.beside.open);
        button.addEventListener("click", () => openBeside(this.lab).catch((error) => this.lab.tell(sentence(error), true)));
        return button;
    }

    chooseCamera(name) {
        const { lab } = this;
        lab.camera.choose(lab.camera.flat && name === "free" ? "above" : name);
        this.showView();
        lab.remember();
        lab.wake();
    }

    /* The controls of the view as the settings are. */
    showView() {
        const { lab } = this, s = lab.settings;
        $("slow").value = String(this.slows.indexOf(s.slow));
        this.showPace();
        $("slow").setAttribute("aria-valuetext", this.paceText(s.slow));
        for (const button of $("cameras").children) {
            button.setAttribute("aria-pressed", String(button.dataset.camera === lab.camera.mode));
            button.hidden = lab.camera.flat && button.dataset.camera === "free";
        }
        $("camera-help").textContent = [T.cameraHelp[lab.camera.mode], canDrag(lab) && T.drag, lab.core.get("magnet.shape") === "grid" && T.mapColours].filter(Boolean).join(" ");
        this.colour.value = s.colour;
        this.turns.value = String(s.turns);
        for (const box of this.arrowBoxes) {
            box.checked = s.arrows.has(box.value);
            box.parentElement.hidden = lab.camera.flat && box.value === "load"; /* it points at the eye */
        }
        this.legend = null;
    }

    /* How much slower the motion is than in reality: what is set, or what this device keeps up with. */
    showPace() {
        const { slow } = this.lab.settings, kept = factorTold(slow, this.lab.pace.slower);
        const text = kept === slow ? this.paceText(slow) : say(T.slowTrue, { n: shown(kept), set: slow === 1 ? T.realTime : shown(slow) });
        if ($("slow-value").textContent !== text)
            $("slow-value").textContent = text;
    }

    paceText(slow) {
        return slow === 1 ? T.realTime : say(T.slowValue, { n: shown(slow) });
    }

    /* ------------------------------------------------------------ plots */

    buildPlots() {
        const texts = ["sweep-from", "sweep-to", "sweep-points"].map((id) => $(id)?.value);
        $("plot-tabs").replaceChildren();
        for (const [name, text] of Object.entries(T.plots)) {
            const tab = element("button", { type: "button", role: "tab", id: `tab-${name}`, "aria-controls": "plot-box" }, text);
            tab.addEventListener("click", () => this.choosePlot(name));
            tab.addEventListener("keydown", (event) => {
                const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key], names = Object.keys(T.plots);
                if (step) {
                    const next = names[(names.indexOf(name) + step + names.length) % names.length];
                    this.choosePlot(next);
                    $(`tab-${next}`).focus();
                    event.preventDefault();
                    event.stopPropagation();
                }
            });
            $("plot-tabs").append(tab);
        }
        const field = (id, text, value) => element("span", {}, element("label", { for: id }, text), " ", element("input", { id, type: "text", inputmode: "decimal", autocomplete: "off", value }));
        this.go = element("button", { type: "submit", class: "strong", id: "sweep-go" }, this.sweeping ? T.sweepStop : T.sweep);
        this.progress = element("span", { id: "sweep-done", role: "status" });
        $("sweep-form").replaceChildren(this.go, field("sweep-from", T.sweepFrom, texts[0] ?? "2"), field("sweep-to", T.sweepTo, texts[1] ?? "30"),
            field("sweep-points", T.sweepPoints, texts[2] ?? "57"), this.progress);
        this.choosePlot(this.plot);
    }

    choosePlot(name) {
        this.plot = name;
        for (const tab of $("plot-tabs").children) {
            const chosen = tab.id === `tab-${name}`;
            tab.setAttribute("aria-selected", String(chosen));
            tab.tabIndex = chosen ? 0 : -1;
        }
        $("plot-box").setAttribute("aria-labelledby", `tab-${name}`);
        $("plot").setAttribute("aria-label", T.plots[name]);
        $("sweep-form").hidden = name !== "sweep";
        this.frame(Infinity);
    }

    async sweep() {
        const { lab } = this, [from, to, count] = ["sweep-from", "sweep-to", "sweep-points"].map((id) => plainOf($(id).value));
        const scene = { ...lab.scene };
        delete scene["drive.omega"];
        lab.pool.stopSweep();
        this.points.clear();
        const mine = (this.sweeping = {});
        this.go.textContent = T.sweepStop;
        this.span = [Math.min(Number(from), Number(to)), Math.max(Number(from), Number(to))];
        try {
            await window.festoonLab.sweep(scene, `drive.frequency=${from}:${to}:${count}`, (point, value, result) => {
                if (this.sweeping !== mine)
                    return;
                if (!(result instanceof Error))
                    this.points.set(point, result);
                this.progress.textContent = say(T.sweepDone, { n: this.points.size, all: count });
                this.frame(Infinity);
            });
        } catch (error) {
            if (error.status !== 8)
                write(this.progress, sentence(error));
        } finally {
            if (this.sweeping === mine) {
                this.sweeping = null;
                this.go.textContent = T.sweep;
            }
        }
    }

    /* The curve belongs to another setup. */
    forgetSweep(setup) {
        const other = this.setup !== undefined && this.setup !== setup;
        this.setup = setup;
        if (!other)
            return;
        this.lab.pool.stopSweep();
        this.points.clear();
        this.progress.textContent = "";
    }

    frame(now) {
        if (now - this.drawn < PLOT_EVERY || !this.lab.units || !this.canvas)
            return;
        this.drawn = Number.isFinite(now) ? now : -Infinity;
        this.showLive();
        this.showPace();
        if (!this.canvas.begin())
            return;
        ({ phi: () => this.drawPhi(), sweep: () => this.drawSweep(), path: () => this.drawPath() })[this.plot]();
    }

    showLive() {
        const { lab } = this, row = lab.row;
        this.showTime(lab.recording);
        const text = lab.ramping ? say(T.rampOn, { f: shown(lab.frequency().toFixed(2)) }) : `${digits(lab.frequency(), 4)} Hz`;
        const rings = lab.core.get("plate.shape") === "none" || lab.core.get("drive.waveform") === "wave" ? "" : ` · ${T.ring}`;
        $("live").textContent = `${text} · ${say(T.live, { turns: shown(row[COLUMN.turns].toFixed(1)), seconds: shown(row[COLUMN.time].toFixed(2)) })}${rings}`;
        const quantity = QUANTITIES[lab.settings.colour], range = lab.trail.count > 1 && lab.range ? lab.range : [NaN, NaN]; // none before the first picture
        const named = typeof quantity.unit === "function" ? quantity.unit(lab.units) : quantity.unit, unit = T.units[named] ?? named;
        const words = `${lab.rows.length} ${lab.settings.colour} ${range.map((v) => digits(v, 3)).join(" ")} ${[...lab.settings.arrows]}`;
        if (words === this.legend)
            return;
        this.legend = words;
        const bar = element("i"), css = (c) => `rgb(${c.map((v) => Math.round(255 * v)).join()})`;
        bar.style.background = `linear-gradient(90deg,${[0, 51, 102, 153, 204, 255].map((i) => css(PALETTE[i])).join()})`;
        const arrows = [...lab.settings.arrows].map((name) => {
            const dot = element("b");
            dot.style.background = ARROWS[name];
            return element("span", {}, dot, T.arrowNames[name]);
        });
        if (lab.rows.length > 1) {
            $("legend").replaceChildren(...arrows, ...lab.rows.map((bead, i) => {
                const dot = element("b");
                dot.style.background = BEADS[i];
                return element("span", {}, dot, say(T.bead, { n: i + 1 }));
            }));
            return;
        }
        const [from, to] = T.ends[lab.settings.colour] ?? [say(T.pair, { name: T.quantities[lab.settings.colour], value: digits(range[0], 3) }), `${digits(range[1], 3)}${unit && ` ${unit}`}`];
        $("legend").replaceChildren(...arrows, element("span", {}, from, bar, to));
    }

    /* The time of what is recorded, which may be moved. */
    showTime(recording) {
        const slider = $("time");
        slider.hidden = !recording;
        if (!recording)
            return;
        slider.max = String(recording.end);
        slider.value = String(this.lab.row[COLUMN.time]);
        slider.setAttribute("aria-valuetext", `${digits(this.lab.row[COLUMN.time], 3)} s`);
    }

    drawPhi() {
        const { canvas, lab } = this, rows = lab.trails.flatMap((trail) => trail.samples.slice(-1400)), degrees = (row) => (((row[COLUMN.phi] * DEGREES) % 360) + 360) % 360;
        const series = [
            [T.plotLabels.r, BLUE, (row) => row[COLUMN.r] * lab.units.mm], [T.plotLabels.nz, ORANGE, (row) => row[COLUMN.nLocal + 2]],
            [say(T.plotLabels.b, { unit: lab.units.tesla ? "mT" : "B₀" }), GREEN, (row) => row[COLUMN.field] * lab.units.field],
        ];
        const unit = (canvas.height - 28) / 3 / canvas.height;
        series.forEach(([label, colour, read], i) => {
            canvas.frame({
                x: [0, 360], every: 60, y: rangeOf([...rows, ...lab.rows].map(read), 0.01), yLabel: label, xLabel: T.plotLabels.phi, from: i * unit, to: i === 2 ? 1 : (i + 1) * unit,
                xTicks: i === 2,
            });
            lab.trails.forEach((trail, k) => {
                const own = lab.trails.length > 1 ? BEADS[k] : colour;
                canvas.dots(trail.samples.slice(-1400).map((row) => [degrees(row), read(row)]), own, 1.1);
                canvas.disc(degrees(lab.rows[k]), read(lab.rows[k]), 4, own, canvas.ink.text);
            });
        });
    }

    drawSweep() {
        const { canvas, lab } = this, mm = lab.units.mm, points = [...this.points.values()].filter((p) => Number.isFinite(p.mean_r));
        const run = Number.isFinite(this.result?.mean_r) && this.result;
        if (!points.length && !run) {
            canvas.note(T.plotLabels.none);
            return;
        }
        const radii = [...points, ...(run ? [run] : [])].map((p) => p.mean_r * mm);
        const span = this.points.size ? this.span : [Math.max(0, run.frequency_hz - 5), run.frequency_hz + 5];
        canvas.frame({ x: rangeOf(span, 0.2), y: rangeOf([0, ...radii], 1), xLabel: T.plotLabels.f, title: T.plotLabels.meanR });
        const sorted = [...points].sort((a, b) => a.frequency_hz - b.frequency_hz);
        canvas.clip(() => {
            canvas.line(canvas.ink.frame, sorted.map((p) => [canvas.atX(p.frequency_hz), canvas.atY(p.mean_r * mm)]));
            for (const p of sorted)
                canvas.disc(p.frequency_hz, p.mean_r * mm, 3.2, regimeColour(p.regime));
        });
        if (run)
            canvas.disc(run.frequency_hz, run.mean_r * mm, 6, regimeColour(run.regime), canvas.ink.text);
        this.drawKey([...new Set([...sorted.map((p) => p.regime), ...(run ? [run.regime] : [])])]);
    }

    drawKey(regimes) {
        const { canvas } = this, { pen, box } = canvas;
        pen.textAlign = "left";
        regimes.forEach((name, i) => {
            const y = box.bottom - 10 - 16 * i;
            pen.beginPath();
            pen.arc(box.right - 118, y - 4, 4, 0, 2 * Math.PI);
            pen.fillStyle = regimeColour(name);
            pen.fill();
            pen.fillStyle = canvas.ink.text;
            pen.fillText(T.regimeNames[name] ?? name, box.right - 110, y);
        });
    }

    drawPath() {
        const { canvas, lab } = this, rows = lab.trail.samples.slice(-1400), at = (row) => [row[COLUMN.nLocal + 1], row[COLUMN.nLocal + 2]];
        canvas.frame({ x: [-1.1, 1.1], y: [-1.1, 1.1], xLabel: T.plotLabels.nAlpha, title: T.plotLabels.nUp, square: true, every: 0.5 });
        canvas.clip(() => canvas.line(canvas.ink.grid, Array.from({ length: 73 }, (_, i) => [canvas.atX(Math.cos((i * Math.PI) / 36)), canvas.atY(Math.sin((i * Math.PI) / 36))])));
        canvas.dots(rows.map(at), BLUE, 1.1);
        canvas.disc(...at(lab.row), 4, BLUE, canvas.ink.text);
    }

    /* ------------------------------------------------------------ numbers of a run */

    fill(rows) {
        $("numbers").replaceChildren(...rows.map(([name, value]) => element("div", {}, element("dt", {}, name), element("dd", {}, value))));
        this.lab.panels.frame(Infinity);
    }

    /* The library's own sentences: what it found, and why. */
    showWhy(...sentences) {
        const given = sentences.filter(Boolean);
        write($("why-text"), given.map(whole).join(" "));
        $("why").hidden = !given.length;
    }

    /* What several beads do. */
    showBeads(result) {
        const mm = 1e3 * result.scales.length_unit_m, hertz = 1 / (2 * Math.PI * result.scales.time_unit_s);
        this.result = result;
        $("regime").textContent = T.outcomes[result.outcome] ?? T.outcomes.undecided;
        this.showWhy(told(result.sentence, "pieces"), result.reason && told(inUnits(result.reason, result.scales)));
        this.fill([
            ...result.beads.map((bead, i) => [say(T.bead, { n: i + 1 }), `${digits(bead.mean_r === null ? null : bead.mean_r * mm)} mm, ${digits(bead.mean_alpha_dot === null ? null : bead.mean_alpha_dot * hertz)} Hz`]),
            [T.rows.touching, result.contacts.filter(({ b }) => b !== null).map(({ a, b }) => `${a + 1}–${b + 1}`).join(", ") || "–"],
            [T.rows.impacts, result.powers.drive ? percent(result.powers.impacts / result.powers.drive) : "–"],
        ]);
    }

    showRun(result) {
        if (result.beads) {
            this.showBeads(result);
            return;
        }
        const { lab } = this, mm = 1e3 * result.groups.length_unit_m, hertz = 1 / (2 * Math.PI * result.groups.time_unit_s);
        this.result = result;
        if (lab.ramping) { // a run knows only the speed from which it began
            $("regime").textContent = T.ramping;
            this.showWhy();
            this.fill([]);
            return;
        }
        const ratio = result.mean_alpha_dot ? Math.abs(result.omega / result.mean_alpha_dot) : null;
        /* Where the symmetry is not known, there are N festoons or 2 N. */
        const unknown = result.festoons === null && result.regime.endsWith("rotating") && ratio !== null;
        const single = Math.abs(1 - result.omega / result.mean_alpha_dot);
        const festoons = unknown ? `${digits(single, 3)} ${T.or} ${digits(2 * single, 3)}` : result.festoons === null ? null : digits(result.festoons, 3);
        const measures = {
            r: digits(result.mean_r === null ? null : result.mean_r * mm), turns: digits(ratio, 3), free: result.scene["friction.law"] === "none", oneOff: result.scene["drive.waveform"] !== "steady",
            festoons,
        };
        $("regime").textContent = regimeSentence(result.regime, measures);
        this.showWhy(result.reason && told(inUnits(result.reason, result.groups)));
        const circles = result.mean_alpha_dot === null ? null : result.mean_alpha_dot * hertz, rate = digits(Math.abs(circles));
        const wave = result.scene["drive.waveform"] === "wave"; /* which has no axis to circle about */
        const rows = wave ? [] : [
            [T.rows.mean_r, result.mean_r === null ? "–" : `${digits(result.mean_r * mm)} mm`],
            [T.rows.std_r, result.std_r === null ? "–" : `${digits(result.std_r * mm, 3)} mm`],
            [T.rows.bead, circles === null ? "–" : rate === "0" ? "0 Hz" : `${rate} Hz ${circles < 0 ? T.against : T.along}`],
            [T.rows.festoons, festoons ?? "–"],
        ];
        rows.push(
            [T.rows.angle, result.max_angle_deg === null ? "–" : `${digits(result.max_angle_deg, 3)}°`],
            [T.rows.slip, result.rms_slip === null ? "–" : `${digits(result.rms_slip * mm / result.groups.time_unit_s, 3)} mm/s`],
            ...(result.never_slips === null ? [] : [[T.rows.sticking, result.sticking === null ? "–" : percent(result.sticking)]]),
            ...(wave ? [] : [[T.rows.symmetry, T.symmetries[result.symmetry] || "–"]]),
            ...(Number.isFinite(result.mean_velocity) ? [[T.rows.velocity, `${digits(result.mean_velocity * mm / result.groups.time_unit_s)} mm/s`]] : []),
            ...(Number.isFinite(result.mean_height) && result.scene["plate.shape"] === "none" ? [[T.rows.height, `${digits(result.mean_height * mm)} mm`]] : []),
        );
        this.fill(lab.recording ? rows.filter(([, value]) => value !== "–") : rows);
    }
}
