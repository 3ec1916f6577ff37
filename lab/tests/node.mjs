/* node.mjs - what can be tested without a browser: the scripts of the page, on the sources alone, with the program; and,
 * where `make lab` has made them, the library in WebAssembly against the program, and the page.  Started by
 * tests/lab/test_lab.py, which sets FESTOON, SOURCE_DIR and BUILD_DIR. */
import assert from "node:assert/strict";
import { execFileSync, spawnSync } from "node:child_process";
import { existsSync, mkdtempSync, readdirSync, readFileSync, rmSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { Camera } from "../src/camera.js";
import { isBeyond, SHOWN, sentence } from "../src/controls.js";
import { COLUMN, COLUMNS, Core } from "../src/core.js";
import { motionTable } from "../src/files.js";
import { bodiesOf, hullOf, magnetisation } from "../src/magnet.js";
import { factorTold, Pace } from "../src/pace.js";
import { ticks } from "../src/plots.js";
import { coarseFirst, Pool } from "../src/pool.js";
import { Recording } from "../src/recording.js";
import { readTrajectory, recordingOf } from "../src/trajectory.js";
import { readAddress, readScene, fitted, readTrack, takeGood, writeAddress, writeScene } from "../src/state.js";
import { regimeSentence } from "../src/panels.js";
import { LESSON, PRESETS } from "../src/scenes.js";
import { inUnits, told } from "../src/said.js";
import { LANGUAGES, languageOf, plainOf, SAID, say, shown, speak, T, TABLES } from "../src/texts.js";
import { goldenHashes } from "./golden.mjs";
import * as said from "./said.mjs";

const { FESTOON, SOURCE_DIR, BUILD_DIR } = process.env;
const wasm = join(BUILD_DIR, "lab", "festoon.wasm"), made = existsSync(wasm) && existsSync(join(BUILD_DIR, "festoon-lab.html"));
const core = made && await Core.open(new WebAssembly.Module(readFileSync(wasm)));
const scratch = mkdtempSync(join(tmpdir(), "festoon-lab-"));
process.on("exit", () => rmSync(scratch, { recursive: true, force: true }));

const sets = (scene) => Object.entries(scene).flatMap(([key, value]) => ["--set", `${key}=${value}`]);
const festoon = (...words) => execFileSync(FESTOON, words, { encoding: "utf8", stdio: ["ignore", "pipe", "pipe"] });
const checked = (...words) => JSON.parse(festoon("check", "--json", ...words)).scene;
const result = (scene) => JSON.parse(festoon("run", "--json", ...sets(scene)));
const ran = (scene) => {
    core.setScene(scene);
    return core.run();
};

const REAL_MAGNET = `magnet:
  shape: parts
  parts:                # a bar, and a disc on its edge
    - kind: cuboid
      centre: [0, 0, 0]
      size: [50 mm, 20 mm, 10 mm]
      remanence: [0.4 T, 0, 0]
    - kind: cylinder
      centre: [0, 30 mm, -2 mm]
      size: [10 mm, 6 mm]
      remanence: [0, 0, 1.1 T]
      rotation: [90, 1, 0, 0]
drive:
  frequency: 8 Hz
`;

const EXAMPLES = ["paper-10.7Hz.yaml", "paper-19.9Hz.yaml"].map((name) => join(SOURCE_DIR, "examples", name));
const SCENES = [{ "drive.frequency": "14.5 Hz", "bead.radius": "3 mm", "friction.law": "coulomb", "friction.mu": "0.3" },
    ...EXAMPLES.map((path) => readScene(readFileSync(path, "utf8"))), readScene(REAL_MAGNET)];
const written = (scene) => {
    const file = join(scratch, "scene.yaml");
    writeFileSync(file, writeScene(scene, "a test"));
    return file;
};

/* A page's frames on an artificial clock: a motion that moves while `moving`, each frame after `gap` seconds of which
 * `work` go into the motion. */
function frames(gap, work, slow) {
    const calls = [];
    let clock = 0;
    const film = { moving: true, drawn: 0, simulated: 0, clock: () => clock };
    film.pace = new Pace((now) => {
        film.drawn += 1;
        if (!film.moving)
            return;
        film.pace.go(now, slow, (seconds) => {
            clock += 1e3 * work;
            const done = work > 0.06 ? seconds * 0.06 / work : seconds; /* as much as a frame may take */
            film.simulated += done;
            return done;
        });
        film.pace.wake();
    }, (call) => calls.push(call), () => clock);
    film.pass = (seconds) => {
        for (const end = clock + 1e3 * seconds; clock < end;) {
            const due = calls.splice(0), before = clock;
            due.forEach((call) => call(clock));
            clock = Math.max(clock, before + 1e3 * gap);
        }
    };
    return film;
}

/* Every text of a table by its path; those of a language, with the library's sentences. */
const textsOf = (words, path = "") => (typeof words === "string" ? [[path, words]] : Object.entries(words).flatMap(([key, value]) => textsOf(value, `${path}/${key}`)));
const textsIn = (language) => [...textsOf(TABLES[language]), ...textsOf(SAID[language], "/said")];

/* On the sources alone. */
const scripts = {
    "a page that stands still asks for no frame, and one for all that changed since the last"() {
        const film = frames(1 / 60, 0, 20);
        film.pace.wake();
        film.pass(1);
        assert.ok(film.drawn >= 60);
        film.moving = false;
        film.pass(1 / 30);
        const drawn = film.drawn;
        film.pass(60);
        assert.equal(film.drawn, drawn, "paused: nothing for a minute");
        for (let i = 0; i < 5; ++i)
            film.pace.wake();
        film.pass(1);
        assert.equal(film.drawn, drawn + 1);
    },
    "slow motion is as slow as it says: at 60, 5 and 1.5 pictures a second, and where the device cannot keep up"() {
        for (const gap of [1 / 60, 1 / 5, 1 / 1.5]) {
            const film = frames(gap, 0, 20);
            film.pace.wake();
            film.pass(30);
            assert.ok(Math.abs(film.simulated * 20 - 30) < 1.01 * gap + 1e-9, `${film.simulated} s in 30 s, a picture in ${gap} s`);
            assert.equal(factorTold(20, film.pace.slower), 20);
        }
        const film = frames(1 / 60, 0.2, 20);
        film.pace.wake();
        film.pass(30);
        const [clock, simulated] = [film.clock(), film.simulated];
        film.pass(30);
        const slower = (film.clock() - clock) / 1e3 / (film.simulated - simulated);
        assert.ok(slower > 30, "it is slower than is set");
        assert.ok(Math.abs(film.pace.slower / slower - 1) < 1e-6, "and it says how slow");
        assert.equal(factorTold(20, film.pace.slower), Number(slower.toPrecision(2)));
        film.pace.reset();
        assert.equal(factorTold(20, film.pace.slower), 20, "nothing is told before it is measured");
    },
    "a pause is none of the bead's time"() {
        const film = frames(1 / 60, 0, 1);
        film.pace.wake();
        film.pass(1);
        film.moving = false;
        film.pass(100);
        film.pace.reset();
        film.moving = true;
        film.pace.wake();
        film.pass(1);
        assert.ok(Math.abs(film.simulated - 2) < 0.05 && Math.abs(film.pace.slower - 1) < 0.01);
    },
    "one bad key of an address leaves the good ones: the bad are named, with a magnet's part the magnet"() {
        const take = (bad) => (scene) => {
            for (const key of Object.keys(scene))
                if (bad.includes(key))
                    throw Object.assign(new Error(`${key} is bad`), { where: key });
            if (bad.includes("magnet.parts") && Object.keys(scene).some((key) => key.startsWith("magnet.")))
                throw Object.assign(new Error("magnet.parts is bad"), { where: "magnet.parts" });
            if (bad.includes("*"))
                throw Object.assign(new Error("out of memory"), { where: "" });
        };
        const scene = { "drive.frequency": "12 Hz", "start.r": "50", "bead.mass": "x", "magnet.parts[0].kind": "sphere", "magnet.shape": "parts" };
        const kept = (...bad) => {
            const { scene: good, errors } = takeGood(scene, take(bad));
            return [Object.keys(good), errors.map((error) => error.message)];
        };
        assert.deepEqual(kept(), [Object.keys(scene), []]);
        assert.deepEqual(kept("start.r", "bead.mass"), [["drive.frequency", "magnet.parts[0].kind", "magnet.shape"], ["start.r is bad", "bead.mass is bad"]]);
        assert.deepEqual(kept("magnet.parts")[0], ["drive.frequency", "start.r", "bead.mass"]);
        assert.deepEqual(kept("*"), [[], ["out of memory", "out of memory"]]);
    },
    "the first view holds the whole magnet at every turn, on wide and narrow pictures, and fills them"() {
        const groups = { length_unit_m: 0.023, h: 18.7 / 23, eps: 2.5 / 23, lambda: 10 / 23, lines: 5 }, bodies = bodiesOf(groups, 1);
        const [bar] = bodies, row = new Float64Array(COLUMNS), tan = Math.tan((17 * Math.PI) / 180);
        const minus = (a, b) => a.map((v, i) => v - b[i]), dot = (a, b) => a.reduce((sum, v, i) => sum + v * b[i], 0);
        const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
        for (const mode of ["free", "above", "magnet"])
            for (const aspect of [890 / 496, 1310 / 670, 374 / 359, 0.5]) {
                const camera = new Camera();
                camera.choose(mode);
                camera.strip = mode === "above" ? 0.1 : 0;
                let most = 0, top = 0;
                for (let turn = 0; turn < 1; turn += 1 / 64) {
                    row[COLUMN.turns] = turn;
                    const { eye, target, up } = camera.look(row, groups.eps, hullOf(bodies, 1.2, groups.eps), aspect, 34);
                    const size = Math.hypot(...minus(eye, target)), towards = minus(eye, target).map((v) => v / size), right = cross(up, towards);
                    for (let corner = 0; corner < 8; ++corner) {
                        const [x, y, z] = bar.size.map((edge, i) => bar.centre[i] + ((corner >> i) & 1 ? edge : -edge) / 2), a = 2 * Math.PI * turn;
                        const p = minus([x * Math.cos(a) - y * Math.sin(a), x * Math.sin(a) + y * Math.cos(a), z], target), far = size - dot(p, towards);
                        most = Math.max(most, Math.abs(dot(p, right)) / far / tan / aspect, Math.abs(dot(p, up)) / far / tan);
                        top = Math.max(top, dot(p, up) / far / tan);
                    }
                }
                assert.ok(most < 1 && top < 1 - 2 * camera.strip, `${mode}, ${aspect}: ${most}, ${top}`);
                assert.ok(most > 0.75 || mode === "magnet", `${mode}, ${aspect}: ${most} leaves the picture empty`);
            }
    },
    "a page speaks in words: every parameter and choice has one, and no sentence holds a measure that is an error"() {
        for (const row of JSON.parse(festoon("schema", "--json")).filter((own) => own.parts === null && own.kind !== "text" && !isBeyond(own.key))) {
            assert.ok(T.names[row.key], `${row.key} has a name`);
            for (const name of row.names || [])
                assert.ok(T.choices[row.key]?.[name], `${row.key}: ${name} has a word`);
        }
        for (const name of Object.values(T.names))
            assert.ok(!/_|\w\.\w/.test(name), name);
        assert.match(regimeSentence("undecided", { free: true, r: "14.6" }), /^Without friction/);
        assert.match(regimeSentence("undecided", { free: true, oneOff: true }), /^This drive/);
        assert.match(regimeSentence("constructor", {}), /^Undecided/);
        for (const regime of Object.keys(T.regimeNames))
            for (const free of [true, false]) {
                const text = regimeSentence(regime, { r: "1", turns: "2", festoons: null, free, reason: "the Lyapunov exponent is 1 +- 2" });
                assert.ok(!/undefined|null|NaN|Lyapunov|\+-|±|festoons/.test(text), text);
            }
        assert.match(regimeSentence("counter-rotating", { turns: "3.19", festoons: "4.19" }), /draws 4\.19 festoons a lap/);
    },
    "each language has every word: the same keys, the same places, and no English but names and units"() {
        const placesIn = (text) => (text.match(/\{\w+\}/g) ?? []).sort();
        /* What is the same in English, and may be. */
        const same = {
            de: ["/pair", "/percent", "/sentence", "/plots/path", "/worksheet/name", "/groups/magnet", "/groups/start", "/said/sentences/key", "/said/pieces/more"],
            fr: ["/pause", "/sentence", "/plots/path", "/quantities/r", "/groups/contact", "/worksheet/date", "/said/pieces/more", "/said/numbers/six"],
            es: ["/pair", "/percent", "/sentence", "/said/sentences/key", "/said/pieces/more"], zh: ["/said/words/time"],
        };
        assert.deepEqual(Object.keys(LANGUAGES), Object.keys(TABLES));
        const english = new Map(textsIn("en"));
        for (const [language, table] of Object.entries(TABLES)) {
            const own = new Map(textsIn(language));
            assert.deepEqual([...own.keys()].sort(), [...english.keys()].sort(), language);
            assert.equal(table.lesson.length, LESSON.length);
            table.lesson.forEach((step, i) => assert.ok(step.answers.length === 3 && LESSON[i].answer < 3 && new Set(step.answers).size === 3));
            assert.deepEqual(Object.keys(table.presetNames), PRESETS.map(({ id }) => id), language);
            assert.equal(table.lang.slice(0, 2), language);
            if (language === "en")
                continue;
            assert.deepEqual([...own].filter(([path, text]) => text === english.get(path)).map(([path]) => path).sort(), same[language].sort(), `${language}: still English`);
            for (const [path, text] of own) {
                assert.ok(text.trim() === text && text !== "", `${language} ${path}`);
                assert.deepEqual(placesIn(text), placesIn(english.get(path)), `${language} ${path}`);
            }
        }
    },
    "numbers that a translated text states are those of the English one, written as the language writes them"() {
        const numbersIn = (text) => (text.replace(/\{\w+\}|x \[mm\].*/g, "").match(/\d+(?:[.,]\d+)?/g) ?? []).map((number) => number.replace(",", ".")).sort();
        const english = new Map(textsIn("en"));
        for (const language of ["de", "fr", "es", "zh"])
            for (const [path, text] of textsIn(language)) {
                assert.deepEqual(numbersIn(text), numbersIn(english.get(path)), `${language} ${path}`);
                assert.ok(!(language === "zh" ? /\d,\d/ : /\d\.\d/).test(text), `${language} ${path}: another language's decimal sign`);
            }
    },
    "each language has its own quotation marks and spaces"() {
        /* What no text of a language has. */
        const foreign = {
            de: /[”«»']/, fr: /[“”„']| [;!?:»%]|« |[^\u202f][;!?»]|[^\u00a0]:(?! valeur)|«[^\u202f]/, es: /[“”„']/, zh: /[«»„']|\p{Script=Han}[,;:?!]|[,;?!]\p{Script=Han}/u,
        };
        const pairs = { de: ["„", "“"], fr: ["«", "»"], es: ["«", "»"], zh: ["“", "”"] };
        for (const [language, marks] of Object.entries(foreign))
            for (const [path, text] of textsIn(language)) {
                assert.ok(!marks.test(path === "/bad/row" ? text.replace("键: 值", "") : text), `${language} ${path}: ${text}`);
                assert.equal(...pairs[language].map((mark) => text.split(mark).length), `${language} ${path}`);
                if (language === "es")
                    assert.ok(text.split("¿").length === text.split("?").length && text.split("¡").length === text.split("!").length, path);
            }
    },
    "numbers are shown with the language's comma, and typed with comma or point they are the library's"() {
        try {
            for (const [language, comma] of Object.entries({ en: ".", de: ",", fr: ",", es: ",", zh: "." })) {
                speak(language);
                assert.equal(shown("900.5 rpm"), `900${comma}5 rpm`);
                assert.equal(shown(10.7), `10${comma}7`);
                for (const text of ["10.7 Hz", "-3.25 deg", "1e-3", "0.3cm", "1.5e3 Pa", "9.81 m/s^2", "7500 kg/m^3"])
                    assert.equal(plainOf(shown(text)), text, language);
                assert.deepEqual(["-3", "2e-7 m", "1-2", "farago-2", "5 A m^2"].map(shown), ["−3", "2e−7 m", "1-2", "farago-2", "5 A m²"]);
            }
            speak("zh");
            assert.equal(plainOf("１０．７ Hz"), "10.7 Hz");
            speak("de");
            assert.equal(plainOf(" −2,5 "), "-2.5");
            assert.equal(plainOf("1.000,5"), "1.000,5", "which the library refuses, as a number with a comma");
            assert.equal(inUnits("it left at t = 3968.172764, after 2538.4 drive periods, at r = 10", { length_unit_m: 0.023, time_unit_s: 0.0032 }),
                "it left at t = 12.7 s, after 2538.4 drive periods, at r = 230 mm");
            assert.equal(told("the bead passed the plate's edge at t = 12.7 s, after 2538.4 drive periods, at r = 230 mm"),
                "die Kugel überschritt den Plattenrand bei t = 12,7 s, nach 2538,4 Umdrehungen des Antriebs, bei r = 230 mm");
            assert.equal(say(T.sweepDone, { n: "{all}", all: 3 }), "{all} von 3 Punkten");
        } finally {
            speak("en");
        }
        assert.equal(plainOf("1,000"), "1,000", "in English a comma is not a decimal sign");
        assert.deepEqual([languageOf(["pt-BR", "fr-CA", "en"]), languageOf(["zh-CN"]), languageOf([]), languageOf(["constructor"])], ["fr", "zh", "en", "en"]);
    },
    "an address comes back as it went, and unknown keys are named"() {
        const keys = new Set(JSON.parse(festoon("schema", "--json")).map((row) => row.key)), known = (key) => keys.has(key);
        const scene = { "drive.frequency": "642 rpm", "start.phi": "-3 deg", "friction.law": "coulomb" }, view = { "ui.slow": "50", "ui.camera": "magnet", "ui.lang": "de" };
        const address = writeAddress(scene, view);
        assert.deepEqual(readAddress(address, known), { scene, view, unknown: [] });
        assert.deepEqual(readAddress("#v=1&drive.frequncy=3&<b>=1", known).unknown, ["drive.frequncy", "<b>"]);
        const poor = readAddress("#v=1&ui.slow=abc&ui.settle=&ui.camera=side&ui.colour=constructor&ui.arrows=field,toString&ui.trail=9&ui.lang=tlh&start.phi=1", known);
        assert.deepEqual(poor, { scene: { "start.phi": "1" }, view: { "ui.trail": "9" }, unknown: ["ui.slow=abc", "ui.settle=", "ui.camera=side", "ui.colour=constructor", "ui.arrows=field,toString", "ui.lang=tlh"] });
    },
    "scenes are written as festoon reads them, and read as festoon writes them"() {
        assert.deepEqual(checked(written(SCENES[0])), checked(...sets(SCENES[0])));
        assert.deepEqual(checked(written(readScene(festoon("init", "-", ...sets(SCENES[0]))))), checked(...sets(SCENES[0])));
        const real = join(scratch, "real.yaml");
        writeFileSync(real, REAL_MAGNET);
        for (const path of [real, ...EXAMPLES])
            assert.deepEqual(checked(written(readScene(readFileSync(path, "utf8")))), checked(path));
        assert.throws(() => readScene("drive:\n  - 1\n"), /line 2/);
        assert.throws(() => readScene("drive:\n  omega: 1\n  omega: 2\n"), /line 3/);
    },
    "vectors and lists of beads are read and written, in lines and in braces"() {
        for (const folder of ["beads", "worlds"])
            for (const name of readdirSync(join(SOURCE_DIR, "examples", folder))) {
                const path = join(SOURCE_DIR, "examples", folder, name);
                assert.deepEqual(checked(written(readScene(readFileSync(path, "utf8")))), checked(path), name);
            }
        const scene = readScene("drive: {frequency: 30 Hz}\nbeads:\n  - {start.phi: 3 deg, start.n: [1, 0, 0]}\n  - start.phi: 40 deg\n    bead.radius: 2 mm\nstart:\n  spin: rest\n");
        assert.deepEqual(scene, {
            "drive.frequency": "30 Hz", "beads[0].start.phi": "3 deg", "beads[0].start.n[0]": "1", "beads[0].start.n[1]": "0", "beads[0].start.n[2]": "0",
            "beads[1].start.phi": "40 deg", "beads[1].bead.radius": "2 mm", "start.spin": "rest",
        });
        assert.throws(() => readScene("beads:\n  - {start.phi 3}\n"), /line 2/);
    },
    "a saved motion has each bead, and the height of what is recorded"() {
        const units = { mm: 20, field: 5, speed: 300, tesla: true }, row = (bead) => Array.from({ length: COLUMNS }, (_, k) => k + 1 + 100 * bead);
        const table = (beads, recorded) => motionTable(Array.from({ length: beads }, (_, i) => ({ samples: [row(i), row(i)] })), units, recorded).trim().split("\n").map((line) => line.split(","));
        const factors = { x: 20, y: 20, z: 20, r: 20, Phi: 180 / Math.PI, nx: 1, ny: 1, nz: 1, B: 5, slip_r: 300, slip_alpha: 300, load: 1, sticks: 1 };
        const places = { Phi: COLUMN.phi, nx: COLUMN.n, ny: COLUMN.n + 1, nz: COLUMN.n + 2, B: COLUMN.field, slip_r: COLUMN.slip, slip_alpha: COLUMN.slip + 1 };
        for (const [beads, recorded, without] of [[1, false, ["z"]], [1, true, ["slip_r", "slip_alpha", "sticks"]], [3, true, ["slip_r", "slip_alpha", "sticks"]]]) {
            const [heads, first, second] = table(beads, recorded), names = Object.keys(factors).filter((name) => !without.includes(name));
            const all = Array.from({ length: beads }, (_, i) => names.map((name) => [name, i])).flat();
            assert.deepEqual(heads.map((head) => head.split(" ")[0]), ["t", "turns", ...all.map(([name, i]) => (beads > 1 ? `${name}_${i}` : name))]);
            assert.deepEqual(first.slice(2).map(Number), all.map(([name, i]) => factors[name] * row(i)[places[name] ?? COLUMN[name]]));
            assert.deepEqual(second, first);
        }
    },
    "a recording goes on from sample to sample, and between them by straight lines and the short turn"() {
        const sample = (time, x, turn) => {
            const row = new Float64Array(COLUMNS);
            row[COLUMN.time] = time;
            row[COLUMN.x] = x;
            row.set(turn, COLUMN.turn);
            return row;
        };
        const recording = new Recording(), passed = [], half = Math.SQRT1_2;
        recording.add([sample(0, 1, [0, 0, 0, 1]), sample(2, 3, [0, 0, -half, -half])]);
        const [row] = recording.go(1, (rows) => passed.push(rows[0][COLUMN.time]));
        assert.equal(row[COLUMN.x], 2);
        assert.ok(Math.abs(row[COLUMN.turn + 2] - Math.sin(Math.PI / 8)) < 1e-12, "a quarter of a turn, half way");
        recording.add([sample(3, 5, [0, 0, 1, 0])]);
        assert.equal(recording.go(9, (rows) => passed.push(rows[0][COLUMN.time]))[0][COLUMN.x], 5);
        assert.deepEqual([passed, recording.end], [[2, 3], 3]);
    },
    "a track is read about the centre of its circle, and a bad one is refused by line"() {
        const places = Array.from({ length: 50 }, (_, i) => [7 + 20 * Math.cos(i), -3 + 20 * Math.sin(i)]);
        const { tracks: [points], unit } = readTrack(`frame,t [s],x [mm],y [mm]\n${places.map((p, i) => `${i},${i / 10},${p[0]},${p[1]}`).join("\n")}\n`);
        assert.equal(unit, "mm");
        points.forEach((p) => assert.ok(Math.abs(Math.hypot(...p) - 20) < 1e-9));
        for (const [word, per] of [["mm", 1], ["cm", 10], ["m", 1000]])
            readTrack(`x [${word}],y [${word}]\n${places.map((p) => `${p[0] / per},${p[1] / per}`).join("\n")}\n`).tracks[0].forEach((p) =>
                assert.ok(Math.abs(Math.hypot(...p) - 20) < 1e-9, word));
        assert.throws(() => readTrack("a,b\n1,2\n"), /line 1/);
        assert.throws(() => readTrack("x [mm],y [mm]\n1,2\n3,oops\n"), /line 3/);
        assert.throws(() => readTrack("x [furlong],y\n1,2\n"), /furlong/);
        assert.throws(() => readTrack("x [constructor],y\n1,2\n"), /line 1: "constructor"/);
        assert.throws(() => readTrack("# a film\n\nx,y\n1,1\n1,oops\n"), /line 5/);
        assert.throws(() => readTrack("x,y\n1e300,1\n2,3\n4,-1e300\n"), /line 2/);
        assert.throws(() => readTrack("x,y\n1,1\n1,1\n1,1\n"), /the same/);
        assert.throws(() => readTrack(`x${" ".repeat(1e6)}z,y\n1,1\n`), /three places/, "and at once");
    },
    "a track of several beads is a line of each, about the common centre of their circles"() {
        const rows = Array.from({ length: 60 }, (_, i) => [["1", 7 + 20 * Math.cos(i / 9), -3 + 20 * Math.sin(i / 9)], ["2", 7 + 5 * Math.cos(2 - i / 20), -3 + 5 * Math.sin(2 - i / 20)]]).flat();
        const table = (list) => `t [s],x [mm],y [mm],track,doubts\n${list.map(([bead, x, y]) => `0,${x},${y},${bead},0`).join("\n")}\n`;
        const { tracks, unit } = readTrack(table(rows)), radii = [20, 5];
        assert.deepEqual([tracks.map((points) => points.length), unit], [[60, 60], "mm"]);
        tracks.forEach((points, k) => points.forEach((p) => assert.ok(Math.abs(Math.hypot(...p) - radii[k]) < 1e-9, "though the arcs are short")));
        assert.equal(readTrack(table([["1", 0, 0], ["2", 9, 0], ["2", 9, 1]])).tracks.length, 2, "one may be seen once");
        assert.throws(() => readTrack(table([["1", 0, 0], ["2", 9, 0], ["1", 0, 0]])), /the same/);
        assert.throws(() => readTrack(table(Array.from({ length: 20 }, (_, i) => [i, i, 0]))), /line 10: a track of more than 8 beads/);
    },
    "a table is read as a spreadsheet saves it: semicolons or tabs, decimal commas, empty lines, quoted remarks"() {
        const places = Array.from({ length: 50 }, (_, i) => [7 + 20 * Math.cos(i), -3 + 20 * Math.sin(i)]), number = (value) => value.toExponential(12).replace(".", ",").replace("e", "E");
        const plain = readTrack(`x [mm],y [mm]\n${places.map((p) => p.map((value) => value.toExponential(12)).join()).join("\n")}\n`);
        for (const sign of [";", "\t"]) {
            const saved = `\uFEFF"# a film, of ""mine"""${sign}${sign}\r\nframe${sign}x [mm]${sign}y [mm]\r\n${places.map((p, i) => [i, ...p.map(number)].join(sign)).join("\r\n")}\r\n${sign}${sign}\r\n`;
            assert.deepEqual(readTrack(saved), plain);
        }
        assert.deepEqual(readTrack("x;y\n1.5;2\n3;4,5\n6;7\n").unit, "px");
        assert.throws(() => readTrack("x;y\n1.000,5;2\n"), /line 2/);
        assert.throws(() => readTrack("x,y\n1;5\n2;6\n3;7\n"), /three places/, "the line of names says what the signs are");
        const csv = join(scratch, "sheet.csv"), beads = ["beads[0].start.phi=3deg", "beads[1].start.phi=53deg"], levitating = Object.entries(PRESETS.find(({ id }) => id === "levitation").scene).map((pair) => pair.join("="));
        for (const sets of [["drive.frequency=10.7Hz"], beads, [...levitating, "run.duration=0.02 s"]]) {
            festoon("run", ...[...sets, "run.periods=2", "run.discard=1"].flatMap((set) => ["--set", set]), "--units", "lab", "--csv", csv);
            const text = readFileSync(csv, "utf8"), own = readTrajectory(text);
            for (const sign of [";", "\t"]) {
                const width = text.split("\n").find((line) => !line.startsWith("#")).split(",").length;
                const saved = text.split("\n").map((line) => {
                    const cells = line.startsWith("#") ? line.split(",") : line.replaceAll(".", "{").split(",").map((cell) => cell.replace("{", ","));
                    return cells.concat(Array(Math.max(0, width - cells.length)).fill("")).join(sign);
                }).join("\r\n");
                assert.deepEqual(JSON.stringify(readTrajectory(saved).scene), JSON.stringify(own.scene));
                assert.deepEqual([...readTrajectory(saved).columns], [...own.columns]);
                assert.deepEqual(readTrajectory(saved).rows.map(({ cells, number: line }) => [line, ...cells.map(Number)]), own.rows.map(({ cells, number: line }) => [line, ...cells.map(Number)]));
            }
        }
    },
    async "a worker that memory ran out in is replaced by another"() {
        const answers = [{ problem: { message: "WebAssembly.Instance(): Out of memory" } }, {}, { problem: { status: 6, message: "out of memory" } }, {}, { result: 7 }, { problem: { status: 1, message: "bad" } }, { result: 8 }];
        let begun = 0, ended = 0;
        globalThis.Worker = class {
            constructor() {
                begun += 1;
            }

            postMessage({ id }) {
                const answer = answers.shift();
                queueMicrotask(() => this.onmessage({ data: { id, ...answer } }));
            }

            terminate() {
                ended += 1;
            }
        };
        const pool = new Pool(null, "", 1), said = () => pool.run({}).then((result) => result, sentence);
        assert.deepEqual([await said(), await said(), await said(), await said(), await said()], [T.noMemory, T.noMemory, 7, "bad", 8]);
        assert.deepEqual([begun, ended, answers.length], [3, 2, 0]);
        delete globalThis.Worker;
    },
    "points of a sweep are done once each, coarse ones first"() {
        for (const count of [1, 2, 3, 57, 64])
            assert.deepEqual([...coarseFirst(count)].sort((a, b) => a - b), Array.from({ length: count }, (_, i) => i));
        const first = coarseFirst(57).slice(0, 6).sort((a, b) => a - b);
        assert.ok(first.every((value, i) => i === 0 || value - first[i - 1] < 57 / 3));
    },
    "ticks are round and within the range"() {
        assert.deepEqual(ticks(0, 1, 5), [0, 0.2, 0.4, 0.6, 0.8, 1]);
        assert.deepEqual(ticks(-0.53, 0.96, 3), [-0.5, 0, 0.5]);
    },
    "an eye above looks straight down, and riding with the magnet turns with it"() {
        const camera = new Camera(), row = new Float64Array(COLUMNS);
        camera.choose("magnet");
        row[COLUMN.magnet] = 3.25;
        const look = camera.look(row, 0.1, [[1.5, 0]], 1, 34);
        assert.ok(Math.abs(look.eye[0]) < 1e-9 && Math.abs(look.eye[1]) < 1e-9 && look.eye[2] > 4);
        [-1, 0, 0].forEach((value, i) => assert.ok(Math.abs(look.up[i] - value) < 1e-9, "X of the magnet, now along Y, is to the right"));
    },
    "presets and lesson say what runs say"() {
        const regimes = { locked: "locked", four: "counter-rotating", twelve: "counter-rotating", many: "counter-rotating", dry: "counter-rotating", discs: "counter-rotating" };
        for (const [id, regime] of Object.entries(regimes))
            assert.equal(result({ ...PRESETS.find((preset) => preset.id === id).scene, "run.periods": 200 }).regime, regime, id);
        const preset = (id) => result(PRESETS.find((found) => found.id === id).scene);
        assert.deepEqual([preset("walker").outcome, preset("opposite").outcome], ["walker", "apart"]);
        assert.deepEqual([preset("levitation").regime, preset("bowl").regime], ["levitating", "counter-rotating"]);
        assert.equal(result(PRESETS.find(({ id }) => id === "twelve").scene).festoons.toFixed(0), "12");
        for (const step of LESSON)
            checked(...sets(step.scene));
        const gear = result({ "drive.frequency": 10.7 });
        assert.equal(gear.max_angle_deg.toFixed(1), "4.4");
        assert.equal(gear.festoons.toFixed(2), "4.19");
        const [at9, at10, at14, at20] = [9.1, 10.7, 14.5, 20].map((f) => result({ "drive.frequency": f }));
        assert.ok(at9.mean_r < at10.mean_r && at10.mean_r < at14.mean_r, "the radius grows at first");
        assert.ok(Math.abs(at20.mean_r / at14.mean_r - 1) < 0.05 && at20.std_r < at14.std_r && at14.std_r < at10.std_r, "then it hardly changes");
        assert.equal(at14.festoons.toFixed(1), "12.2");
        const dry = result({ "friction.law": "coulomb", "drive.frequency": 10.7 });
        assert.equal((100 * dry.sticking).toFixed(0), "37");
        assert.equal(dry.captures_per_return, 3);
    },
};

/* With the library in WebAssembly, and the page. */
const library = {
    "the bits of trajectories and Jacobians are those of test_golden.c"() {
        const source = readFileSync(join(SOURCE_DIR, "tests", "ode", "test_golden.c"), "utf8");
        const [trajectories, jacobians] = /TRAJECTORIES = UINT64_C\(0x(\w+)\), JACOBIANS = UINT64_C\(0x(\w+)\)/.exec(source).slice(1);
        assert.deepEqual(goldenHashes(core), { trajectories, jacobians });
    },
    "a run has every digit of festoon run --json, and its keys in their order"() {
        for (const scene of [{ "drive.frequency": "642 rpm", "run.periods": 60 }, { "drive.frequency": 3, "run.periods": 40, "run.discard": 20 },
            { "friction.law": "coulomb", "run.periods": 40, "run.discard": 10 }, { "bead.material": "mixed", "bead.b": 1e-3, "run.periods": 40 },
            { "friction.law": "none", "run.periods": 20 }]) {
            assert.equal(JSON.stringify(ran(scene)), JSON.stringify(result(scene)));
        }
        const file = join(scratch, "magnet.yaml");
        writeFileSync(file, `${REAL_MAGNET}run:\n  periods: 30\n`);
        assert.equal(JSON.stringify(ran({ ...readScene(REAL_MAGNET), "run.periods": 30 })), JSON.stringify(JSON.parse(festoon("run", file, "--json"))));
    },
    "several beads and a bowl: a run says what festoon run --json says, and its recording what the trajectory"() {
        /* their angles are of the C library, whose last digit is another one here */
        const same = (mine, theirs, where) => {
            if (typeof theirs === "number")
                assert.ok(Math.abs(mine - theirs) <= 1e-11 * Math.abs(theirs) + 1e-13, `${where}: ${mine}, ${theirs}`);
            else if (theirs === null || typeof theirs !== "object")
                assert.equal(mine, theirs, where);
            else
                Object.keys(mine).filter((key) => Array.isArray(theirs) || key in theirs).forEach((key) => same(mine[key], theirs[key], `${where}.${key}`));
        };
        const pair = { "drive.frequency": "30 Hz", "beads[0].start.phi": "3 deg", "beads[1].start.phi": "53 deg", "run.periods": 4, "run.discard": 1 };
        const bowl = { "plate.shape": "bowl", "plate.bowl_radius": "150 mm", "run.periods": 4, "run.discard": 1 };
        for (const scene of [pair, bowl]) {
            const mine = ran(scene), theirs = result(scene), csv = join(scratch, "recorded.csv"), samples = [];
            for (const [key, value] of Object.entries(mine).filter(([name]) => name in theirs))
                same(value, theirs[key], key);
            for (const key of scene === pair ? ["beads", "groups", "outcome", "contacts", "powers", "energy_residual", "counts"] : ["regime", "final_lab", "mean_height"])
                assert.ok(key in mine, key);
            festoon("run", ...sets(scene), "--csv", csv);
            const lines = readFileSync(csv, "utf8").split("\n").filter((line) => line && !line.startsWith("#")).map((line) => line.split(","));
            const place = (name) => lines[0].findIndex((head) => head.split(" ")[0] === name);
            core.record((rows) => {
                samples.push(Array.from(rows));
                return false;
            });
            assert.equal(samples.length, lines.length - 1);
            lines.slice(1).forEach((line, i) => (scene === pair ? [0, 1] : [0]).forEach((bead) => {
                const row = samples[i].slice(COLUMNS * bead), angle = 2 * Math.PI * row[COLUMN.magnet], [x, y, z] = ["X", "Y", "Z"].map((name) => Number(line[place(`${name}_${bead}`)]));
                const off = [row[COLUMN.x] - (x * Math.cos(angle) - y * Math.sin(angle)), row[COLUMN.y] - (x * Math.sin(angle) + y * Math.cos(angle)), row[COLUMN.z] - z];
                assert.ok(off.every((value) => Math.abs(value) < 1e-12), `row ${i}, bead ${bead}: ${off}`);
                if (scene === pair)
                    assert.equal(row[COLUMN.touches] > 0, !/nan/i.test(line[place("force_0_1")]) && line[place("force_0_1")] !== "", `contact in row ${i}`);
            }));
        }
        assert.throws(() => core.setScene({ ...pair, "beads[1].start.phi": "4 deg" }), /overlap|beads/);
        core.reset();
    },
    "a trajectory of festoon run is played as it was recorded, in the units that it has: states, field, loads and contacts"() {
        const csv = join(scratch, "played.csv"), near = (mine, theirs, where, most = 1e-8) => assert.ok(Math.abs(mine - theirs) < most * (1 + Math.abs(theirs)), `${where}: ${mine}, ${theirs}`);
        const played = (scene, units) => {
            festoon("run", ...sets(scene), "--units", units, "--csv", csv);
            const file = readTrajectory(readFileSync(csv, "utf8"));
            core.setScene(file.scene);
            return recordingOf(file, core);
        };
        const single = { "drive.frequency": "10.7 Hz", "run.periods": 5, "run.discard": 1 };
        for (const units of ["scaled", "lab", "si"])
            for (const scene of [single, { ...single, "friction.law": "coulomb" }]) {
                const rows = played(scene, units);
                assert.equal(rows.length, 5 * 64 + 1);
                core.setScene(scene);
                let own = core.start();
                const most = scene["friction.law"] ? 1e-6 : 1e-8; // the steps of this motion end elsewhere, and so where it slips
                rows.forEach((row, i) => {
                    if (i > 0)
                        own = core.go(1 / 64 / 10.7, 1).rows;
                    for (const name of ["time", "turns", "omega", "x", "y", "r", "phi", "alpha", "field", "slipSize", "spin", "load", "friction", "use", "sticks", "speed", "z", "magnet"])
                        near(row[COLUMN[name]], own[COLUMN[name]], `${scene["friction.law"]}, ${units}, row ${i}: ${name}`, most);
                    for (const name of ["n", "b", "nLocal"])
                        [0, 1, 2].forEach((k) => near(row[COLUMN[name] + k], own[COLUMN[name] + k], `${units}, row ${i}: ${name} ${k}`, most));
                });
            }
        const pair = { "drive.frequency": "30 Hz", "beads[0].start.phi": "3 deg", "beads[1].start.phi": "53 deg", "run.periods": 4, "run.discard": 1 };
        const bowl = { "plate.shape": "bowl", "plate.bowl_radius": "150 mm", "run.periods": 4, "run.discard": 1 };
        for (const [scene, units] of [[pair, "scaled"], [pair, "lab"], [bowl, "si"]]) {
            const rows = played(scene, units), own = [];
            core.record((row) => own.push(Array.from(row)) === 0);
            assert.equal(rows.length, own.length);
            rows.forEach((row, i) => row.forEach((value, k) => near(value, own[i][k], `${units}, row ${i}, column ${k}`, k === COLUMN.angle ? 1e-7 : 1e-8))); // acos of nearly 1
        }
        const fly = { "friction.law": "coulomb", "impact.restitution": 0.6, "drive.frequency": "80 Hz", "run.periods": 3, "run.discard": 1 }, flown = played(fly, "lab").map((row) => row[COLUMN.z]), { eps } = core.groups();
        assert.ok(Math.min(...flown) > eps - 1e-12 && Math.max(...flown) > eps + 1e-4, "a bead that flies is seen above the plate");
        played(bowl, "si");
        const text = readFileSync(csv, "utf8"), refused = (change, why) => assert.throws(() => {
            const file = readTrajectory(change(text));
            core.setScene(file.scene);
            recordingOf(file, core);
        }, why);
        const cell = (value) => (whole) => whole.replace(/^0,[^,]*/m, `0,${value}`), line = text.split("\n").findIndex((row) => row.startsWith("0,")) + 1;
        refused(cell("nan"), new RegExp(`line ${line}: drive_turns`));
        refused(cell("<b>"), /drive_turns must be a number/);
        refused((whole) => whole.replace("nY_0 [1]", "nY_0 [furlong]"), /no column nY_0/);
        refused((whole) => whole.replace(/^0,/m, "9,"), new RegExp(`line ${line + 1}: the time`));
        refused((whole) => whole.split("\n").slice(0, line).join("\n"), /three places/);
        refused((whole) => whole.replace("shape: bowl", "shape: bowll"), /bowl/);
        assert.equal(readTrajectory("frame,t [s],x [mm],y [mm]\n"), null);
        core.setScene({});
    },
    "a measured field is the magnet of scenes that name it, with the program's digits; another or none is refused and changes nothing"() {
        const folder = join(SOURCE_DIR, "examples", "magnets"), bytes = readFileSync(join(folder, "measured-map.csv")), scene = { ...readScene(readFileSync(join(folder, "measured-map.yaml"), "utf8")), "run.periods": "20", "run.discard": "10" };
        core.setScene({ "drive.frequency": 12 });
        assert.throws(() => core.setScene(scene), (error) => error.where === "magnet.file" && /does not have the map measured-map\.csv yet/.test(error.message));
        const checksum = core.readMap({ name: "measured-map.csv", bytes });
        core.setScene({ ...scene, "magnet.file": "somewhere/measured-map.csv" });
        const run = spawnSync(FESTOON, ["run", "--json", join(folder, "measured-map.yaml"), "--set", "run.periods=20", "--set", "run.discard=10"], { encoding: "utf8" }), own = core.run(), program = JSON.parse(run.stdout);
        assert.ok(program.scene["magnet.file"].endsWith("measured-map.csv") && program.scene["magnet.checksum"] === checksum);
        assert.deepEqual({ ...own, scene: { ...own.scene, "magnet.file": "" } }, { ...program, scene: { ...program.scene, "magnet.file": "" } });
        assert.equal(run.stderr.trim(), `festoon: warning: ${core.mapDoubt()} (festoon field --smooth)`);
        const { up, radius } = core.mapPicture(64), at = (x, y) => up[32 * 64 + 32 + 64 * y + x];
        assert.ok(Math.abs(radius * 23 - 60) < 1e-9 && Number.isNaN(up[0]) && up.filter(Number.isFinite).length > 3000);
        core.start();
        for (const [x, y] of [[10, 0], [-12, 3], [5, -20]])
            assert.ok(Math.abs(at(x, y) - core.field(radius * (2 * x + 1) / 64, radius * (2 * y + 1) / 64)[2]) < 1e-12, "x to the right, y upwards");
        for (const [bad, why] of [[{ "magnet.checksum": "0123456789abcdef" }, /content of this map has changed/], [{ "magnet.file": "other.csv" }, /does not have the map other\.csv/], [{ "bead.radius": "3 mm" }, /the map was taken at 18\.7 mm/]]) {
            assert.throws(() => core.setScene({ ...scene, ...bad }), why);
            assert.equal(core.run().mean_r, own.mean_r);
        }
        /* The map in use outlives others that are read. */
        const other = new TextEncoder().encode(bytes.toString().replace(/(?<=,)18\.7(?=,)/g, "20"));
        for (let i = 0; i < 3; ++i)
            core.readMap({ name: "measured-map.csv", bytes: other });
        assert.equal(core.run().mean_r, own.mean_r);
        assert.throws(() => core.setScene(scene), /taken at 20 mm/);
        core.setScene({ ...scene, "magnet.checksum": checksum });
        assert.equal(core.run().mean_r, own.mean_r);
        const given = festoon("lab", "--print", join(folder, "measured-map.yaml")).trim();
        core.setScene(readAddress(given.slice(given.indexOf("#")), (key) => core.knows(key)).scene);
        assert.deepEqual([core.get("magnet.shape"), core.get("magnet.checksum"), core.value("drive.frequency")], ["grid", checksum, 14], "festoon lab names the map");
        core.setScene({});
        assert.equal(core.mapDoubt(), "");
    },
    "the points of a grid are those of a sweep"() {
        const base = { "run.periods": 20, "run.discard": 10 }, axis = "drive.frequency=9:20:4", file = join(scratch, "sweep.db");
        festoon("sweep", "--portable", ...sets(base), "--over", axis, "-o", file);
        const rows = JSON.parse(festoon("export", file, "--json"));
        const points = rows.points || rows.rows || rows;
        core.setScene(base);
        assert.throws(() => core.grid("drive.frequency=1:2:1000000000"), /points/);
        assert.equal(core.grid(axis).length, points.length);
        points.forEach((row, i) => {
            core.setScene(base);
            core.grid(axis);
            core.takePoint(i);
            const run = core.run();
            for (const { name } of core.results)
                assert.equal(run[name], row[name], `${name} at point ${i}`);
        });
    },
    "the library's table and sentences reach the page"() {
        const schema = JSON.parse(festoon("schema", "--json"));
        const own = schema.filter((row) => row.parts === null); // the page has no editor for parts of a magnet
        assert.deepEqual(core.parameters.map((row) => row.key), own.map((row) => row.key));
        assert.throws(() => core.setScene({ "drive.freqency": 1 }), /drive\.frequency/);
        assert.throws(() => core.setScene({ "drive.frequency": "12 parsec" }), (error) => error.where === "drive.frequency" && /Hz/.test(error.message));
        core.setScene({});
    },
    "every length, and every unit that the table names, is read as it says: cm too; and shown in a unit that is read back"() {
        const inMetres = { um: 1e-6, mm: 1e-3, cm: 1e-2, m: 1 };
        let lengths = 0;
        const isRead = ({ key, least, greatest }, unit, factor) => {
            const value = Math.sqrt(Math.max(least, 1e-9) * Math.min(greatest, 1e9));
            core.reset();
            core.set(key, `${value / factor} ${unit}`);
            assert.ok(Math.abs(core.value(key) / value - 1) < 1e-14, `${key} in ${unit}`);
        };
        for (const row of core.parameters.filter((info) => info.unit === "m"))
            for (const [unit, factor] of Object.entries(inMetres)) {
                isRead(row, unit, factor);
                lengths += 1;
            }
        assert.ok(lengths >= 20);
        for (const row of core.parameters.filter((info) => info.kind === "real" && info.unit && info.unit !== "1")) {
            const [unit, factor] = isBeyond(row.key) ? [row.unit, 1] : SHOWN[row.unit]; // the page shows no other
            isRead(row, unit, 1 / factor);
        }
        core.setScene({});
    },
    "a start beyond the plate's edge is refused before anything is changed"() {
        core.setScene({ "drive.frequency": 12 });
        assert.throws(() => core.setScene({ "drive.frequency": 13, "start.r": 50 }), (error) => error.where === "start.r" && /edge/.test(error.message));
        assert.equal(core.value("drive.frequency"), 12, "what was there before is there still");
        assert.throws(() => core.setScene({ "start.r": 50 }), (error) => /^start\.r = 50 lies/.test(sentence(error)), "its key is said once");
        assert.throws(() => core.setScene({ "drive.frequency": 13, "bead.mass": "x" }));
        assert.equal(core.value("drive.frequency"), 12);
        const given = { "drive.frequency": "14.5 Hz", "start.r": "50", "magnet.depth": "1.5 cm", "friction.gamma": "fast" };
        const good = takeGood(given, (scene) => core.setScene(scene));
        assert.deepEqual(good.scene, { "drive.frequency": "14.5 Hz", "magnet.depth": "1.5 cm" });
        assert.deepEqual(good.errors.map((error) => error.where), ["friction.gamma", "start.r"]);
        assert.equal(core.value("magnet.depth"), 0.015);
        core.setScene({});
    },
    async "where the browser gives no more memory, each call says so in a sentence, and works again where there is some"() {
        const starved = await Core.open(new WebAssembly.Module(readFileSync(wasm))), scene = { "drive.frequency": "12 Hz", "run.periods": 20 };
        starved.setScene(scene);
        starved.start();
        const whole = JSON.stringify(starved.run()), taken = [];
        for (let size = 2 ** 29; size >= 16; size /= 2)
            for (let at = starved.c.lab_alloc(size); at; at = starved.c.lab_alloc(size))
                taken.push([at, size]);
        const calls = [() => starved.setScene({ ...scene, "bead.mass": "0.6 g" }), () => starved.run(), () => starved.start(), () => starved.change(), () => starved.grid("drive.frequency=9:20:4"), () => starved.knows("bead.mass")];
        let told = 0;
        /* Give back more and more, the smallest first. */
        for (let i = 0; i <= 12; ++i) {
            for (const call of calls)
                try {
                    call();
                } catch (error) {
                    assert.equal(sentence(error), T.noMemory, `${call}: ${error.stack}`);
                    told += 1;
                }
            assert.ok(starved.value("drive.frequency") === 12 && Number.isFinite(starved.go(1e-3, 1).rows[COLUMN.r]), "the motion goes on");
            for (let n = 0; n < 2 && taken.length > 1; ++n)
                starved.c.lab_release(taken.pop()[0]);
        }
        assert.ok(told >= calls.length, "it was short of memory");
        taken.forEach(([at]) => starved.c.lab_release(at));
        starved.setScene(scene);
        assert.equal(JSON.stringify(starved.run()), whole);
        const none = await Core.open(new WebAssembly.Module(readFileSync(wasm)));
        assert.throws(() => none.given(0), (error) => sentence(error) === T.noMemory);
        assert.equal(sentence(new RangeError("WebAssembly.Instance(): Out of memory: Cannot allocate Wasm memory for new instance")), T.noMemory);
    },
    "the friction force drawn is as great as the library says, where the contact slips and where it sticks"() {
        for (const [law, frequency] of [["viscous", 10.7], ["coulomb", 10.7], ["rolling", 12]]) {
            core.setScene({ "friction.law": law, "drive.frequency": frequency });
            core.start();
            const { rows, count } = core.go(0.3, 300);
            let stuck = 0;
            for (let i = 0; i < count; ++i) {
                const row = rows.subarray(i * COLUMNS, (i + 1) * COLUMNS), size = Math.hypot(row[COLUMN.force], row[COLUMN.force + 1]);
                stuck += row[COLUMN.sticks];
                assert.ok(Math.abs(size - row[COLUMN.friction]) < 1e-8 * (1 + size), `${law}, row ${i}: ${size} and ${row[COLUMN.friction]}`);
            }
            assert.equal(stuck > 0, law !== "viscous");
        }
    },
    "the bead turns as its angular velocity says: its axis is the moment, and finer rows converge"() {
        const turned = (count) => {
            core.setScene({});
            core.start();
            const { rows } = core.go(0.2, count);
            return Array.from(rows.subarray((count - 1) * COLUMNS, count * COLUMNS));
        };
        const [coarse, middle, fine] = [250, 1000, 4000].map(turned);
        const [x, y, z, w] = fine.slice(COLUMN.turn, COLUMN.turn + 4);
        const axis = [2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)];
        axis.forEach((value, i) => assert.ok(Math.abs(value - fine[COLUMN.n + i]) < 1e-12));
        const apart = (a, b) => 1 - Math.abs([0, 1, 2, 3].reduce((sum, i) => sum + a[COLUMN.turn + i] * b[COLUMN.turn + i], 0));
        assert.ok(apart(middle, fine) < 1e-6, "less than a tenth of a degree");
        assert.ok(apart(coarse, fine) > 20 * apart(middle, fine), "second order: four times finer, 256 times nearer");
    },
    "a motion goes on smoothly when a parameter changes, and its units with it"() {
        core.setScene({});
        core.start();
        const before = Array.from(core.go(0.5, 1).rows);
        core.setScene({ "friction.gamma": 400, "magnet.half_length": "20 mm", "drive.frequency": "11 Hz" });
        core.change();
        const after = Array.from(core.go(1e-9, 1).rows);
        assert.ok(Math.abs(before[COLUMN.x] * 23 - after[COLUMN.x] * 20) < 1e-5);
        assert.ok(Math.abs(before[COLUMN.speed] * 23 * 312.5 - after[COLUMN.speed] * 20 * 400) < 1e-3);
        for (const name of ["phi", "alpha", "turns", "time"])
            assert.ok(Math.abs(before[COLUMN[name]] - after[COLUMN[name]]) < 1e-6, name);
    },
    "the page opens at the scene that festoon lab was given"() {
        const given = festoon("lab", "--print", ...sets({ "drive.omega": 0.3, "friction.law": "rolling", "bead.radius": "3 mm" })).trim();
        core.setScene(readAddress(given.slice(given.indexOf("#")), (key) => core.knows(key)).scene);
        assert.equal(core.value("drive.omega"), 0.3);
        assert.equal(core.value("bead.radius"), 0.003);
        assert.equal(core.get("friction.law"), "rolling");
    },
    "the library has of a scene what the program has"() {
        for (const scene of SCENES) {
            core.setScene(scene);
            assert.deepEqual(core.scene(), checked(written(scene)));
        }
        assert.equal(core.parts().length, 2);
        for (const name of ["constructor", "__proto__"])
            assert.throws(() => core.setScene(readScene(`${name}: 1\n`)), (error) => error.where === name, "no key is known for what JavaScript calls so");
    },
    "each choice and number of the page can be set, after one other at most, and a choice is made and undone in one step"() {
        const rows = core.parameters.filter(({ key, kind }) => !isBeyond(key) && kind !== "text" && !["magnet.file", "magnet.parts", "magnet.shape"].includes(key));
        const take = (scene) => core.setScene(scene), takes = (scene) => {
            try {
                take(scene);
                return true;
            } catch {
                return false;
            }
        };
        const set = ({ key, kind, otherForm }, value, scene) => {
            const { [key]: before, [otherForm]: other, ...rest } = scene, next = { ...rest, [key]: value };
            return kind === "choice" ? fitted(next, key, take) : next;
        };
        core.setScene({});
        const settings = rows.flatMap((row) => {
            const now = core.value(row.key), other = Number.isFinite(now) && now !== 0 ? Math.min(1.5 * now, row.greatest) : Math.max(1.5 * row.least, 0.4 * Math.min(row.greatest, 1));
            return (row.names ?? [row.kind === "integer" ? Math.round(other) : other]).map((value) => [row, String(value), core.get(row.key)]);
        });
        const first = [{}, { "friction.law": "coulomb" }].flatMap((scene) => [scene, ...settings.map(([row, value]) => set(row, value, scene)).filter(takes)]);
        for (const [row, value, usual] of settings) {
            const after = first.map((scene) => set(row, value, scene)).filter(takes);
            assert.ok(after.length, `${row.key}=${value}`);
            if (row.kind === "choice")
                after.forEach((scene) => assert.ok(takes(set(row, usual, scene)), `from ${JSON.stringify(scene)} back to ${row.key}=${usual}`));
            if (row.kind === "choice")
                assert.equal(after.length, first.length, `${row.key}=${value} in one step`);
        }
        const disc = set(rows.find(({ key }) => key === "contact.patch"), "hertz", { "friction.law": "coulomb", "contact.modulus": "40 GPa" });
        assert.deepEqual(disc, { "friction.law": "coulomb", "contact.modulus": "40 GPa", "contact.patch": "hertz" }, "what is there is enough");
    },
    "the magnet's bar lies below the plate, its north pole where the field points up"() {
        core.setScene({});
        core.start();
        const north = Math.sign(core.field(1, 0)[2]), [bar] = bodiesOf(core.groups(), north);
        assert.ok(Math.abs(bar.centre[2] + 16.2 / 23) < 1e-9 && Math.abs(bar.size[0] * 23 - 56) < 1e-9 && Math.abs(bar.size[1] * 23 - 40) < 1e-9);
        assert.equal(bar.axis[0], north);
        assert.ok(core.field(-1, 0)[2] * north < 0);
        core.setScene(readScene(REAL_MAGNET));
        const bodies = bodiesOf(core.groups(), 1, core.parts(), core.value("magnet.depth"));
        assert.deepEqual(bodies.map((body) => body.kind), ["cuboid", "cylinder"]);
        assert.ok(Math.abs(bodies[1].centre[1] * 23 - 30) < 1e-9 && Math.abs(bodies[1].centre[2] * 23 + 18.2) < 1e-9);
        assert.deepEqual(bodies[1].turn, [90, 1, 0, 0]);
        const lying = magnetisation(bodies[1]);
        assert.ok(lying[1] < -1 && Math.abs(lying[2]) < 1e-12, "counter-clockwise about X, what stood along Z lies against Y");
        assert.deepEqual(magnetisation(bodies[0]), bodies[0].axis);
    },
    "the page is one file of less than 1.1 MB with its version"() {
        const page = join(BUILD_DIR, "festoon-lab.html"), text = readFileSync(page, "utf8");
        assert.ok(statSync(page).size < 1.1e6);
        assert.ok(text.includes(`festoon ${core.version}, results version ${core.resultsVersion}`));
        assert.ok(!/<(?:script|link|img|iframe)[^>]+(?:src|href)="(?!data:)/.test(text), "nothing is loaded from anywhere");
    },
};

let failed = 0;
for (const [name, test] of Object.entries(core ? { ...scripts, ...said.scripts, ...library, ...said.library(core) } : { ...scripts, ...said.scripts })) {
    try {
        await test();
        console.log(`ok: ${name}`);
    } catch (error) {
        failed += 1;
        console.log(`FAILED: ${name}\n${error.stack}`);
    }
}
process.exit(failed ? 1 : 0);
