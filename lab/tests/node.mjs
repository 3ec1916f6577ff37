/* node.mjs - what can be tested without a browser: the library in WebAssembly against the program, and the texts that
 * come from outside.  Started by tests/test_lab.py, which sets FESTOON, SOURCE_DIR and BUILD_DIR. */
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { Camera } from "../src/camera.js";
import { COLUMN, COLUMNS, Core } from "../src/core.js";
import { bodiesOf, magnetisation } from "../src/magnet.js";
import { ticks } from "../src/plots.js";
import { coarseFirst } from "../src/pool.js";
import { readAddress, readScene, readTrack, writeAddress, writeScene } from "../src/state.js";
import { LESSON, PRESETS } from "../src/texts.js";
import { goldenHashes } from "./golden.mjs";

const { FESTOON, SOURCE_DIR, BUILD_DIR } = process.env;
const core = await Core.open(new WebAssembly.Module(readFileSync(join(BUILD_DIR, "lab", "festoon.wasm"))));
const scratch = mkdtempSync(join(tmpdir(), "festoon-lab-"));
process.on("exit", () => rmSync(scratch, { recursive: true, force: true }));

const sets = (scene) => Object.entries(scene).flatMap(([key, value]) => ["--set", `${key}=${value}`]);
const festoon = (...words) => execFileSync(FESTOON, words, { encoding: "utf8", stdio: ["ignore", "pipe", "pipe"] });
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

const tests = {
    "the bits of trajectories and Jacobians are those of test_golden.c"() {
        const source = readFileSync(join(SOURCE_DIR, "tests", "test_golden.c"), "utf8");
        const [trajectories, jacobians] = /TRAJECTORIES = UINT64_C\(0x(\w+)\), JACOBIANS = UINT64_C\(0x(\w+)\)/.exec(source).slice(1);
        assert.deepEqual(goldenHashes(core), { trajectories, jacobians });
    },
    "a run has every digit of festoon run --json, and its keys in their order"() {
        for (const scene of [{ "drive.frequency": "642 rpm", "run.periods": 60 }, { "drive.frequency": 3, "run.periods": 40, "run.discard": 20 },
            { "friction.law": "coulomb", "run.periods": 40, "run.discard": 10 }, { "bead.material": "mixed", "bead.b": 1e-3, "run.periods": 40 },
            { "friction.law": "coulomb", "run.method": "splitting", "run.periods": 40 }, { "friction.law": "none", "run.periods": 20 }]) {
            const expected = JSON.parse(festoon("run", "--json", ...sets(scene)));
            assert.equal(JSON.stringify(ran(scene)), JSON.stringify(expected));
        }
        const file = join(scratch, "magnet.yaml");
        writeFileSync(file, `${REAL_MAGNET}run:\n  periods: 30\n`);
        assert.equal(JSON.stringify(ran({ ...readScene(REAL_MAGNET), "run.periods": 30 })), JSON.stringify(JSON.parse(festoon("run", file, "--json"))));
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
            const result = core.run();
            for (const { name } of core.results)
                assert.equal(result[name], row[name], `${name} at point ${i}`);
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
    "an address comes back as it went, and unknown keys are named"() {
        const known = (key) => core.knows(key);
        const scene = { "drive.frequency": "642 rpm", "start.phi": "-3 deg", "friction.law": "coulomb" }, view = { "ui.slow": "50", "ui.camera": "magnet" };
        const address = writeAddress(scene, view);
        assert.deepEqual(readAddress(address, known), { scene, view, unknown: [] });
        assert.deepEqual(readAddress("#v=1&drive.frequncy=3&<b>=1", known).unknown, ["drive.frequncy", "<b>"]);
        const given = festoon("lab", "--print", ...sets({ "drive.omega": 0.3, "friction.law": "rolling", "bead.radius": "3 mm" })).trim();
        core.setScene(readAddress(given.slice(given.indexOf("#")), known).scene);
        assert.equal(core.value("drive.omega"), 0.3);
        assert.equal(core.value("bead.radius"), 0.003);
        assert.equal(core.get("friction.law"), "rolling");
    },
    "scenes are written as festoon reads them, and read as festoon writes them"() {
        const scene = { "drive.frequency": "14.5 Hz", "bead.radius": "3 mm", "friction.law": "coulomb", "friction.mu": "0.3" }, file = join(scratch, "scene.yaml");
        writeFileSync(file, writeScene(scene, "a test"));
        core.setScene(scene);
        const expected = core.scene();
        assert.deepEqual(JSON.parse(festoon("check", file, "--json")).scene, expected);
        core.setScene(readScene(festoon("init", "-", ...sets(scene))));
        assert.deepEqual(core.scene(), expected);
        const magnet = readScene(REAL_MAGNET), real = join(scratch, "real.yaml");
        writeFileSync(real, writeScene(magnet, "a test"));
        core.setScene(magnet);
        assert.equal(core.parts().length, 2);
        assert.deepEqual(JSON.parse(festoon("check", real, "--json")).scene, core.scene());
        for (const name of ["paper-10.7Hz.yaml", "paper-19.9Hz.yaml"]) {
            const path = join(SOURCE_DIR, "examples", name);
            core.setScene(readScene(readFileSync(path, "utf8")));
            assert.deepEqual(core.scene(), JSON.parse(festoon("check", path, "--json")).scene);
        }
        assert.throws(() => readScene("drive:\n  - 1\n"), /line 2/);
        assert.throws(() => readScene("drive:\n  omega: 1\n  omega: 2\n"), /line 3/);
        for (const name of ["constructor", "__proto__"])
            assert.throws(() => core.setScene(readScene(`${name}: 1\n`)), (error) => error.where === name, "no key is known for what JavaScript calls so");
    },
    "a track is read about the centre of its circle, and a bad one is refused by line"() {
        const places = Array.from({ length: 50 }, (_, i) => [7 + 20 * Math.cos(i), -3 + 20 * Math.sin(i)]);
        const { points, unit } = readTrack(`frame,t [s],x [mm],y [mm]\n${places.map((p, i) => `${i},${i / 10},${p[0]},${p[1]}`).join("\n")}\n`);
        assert.equal(unit, "mm");
        points.forEach((p) => assert.ok(Math.abs(Math.hypot(...p) - 20) < 1e-9));
        assert.throws(() => readTrack("a,b\n1,2\n"), /line 1/);
        assert.throws(() => readTrack("x [mm],y [mm]\n1,2\n3,oops\n"), /line 3/);
        assert.throws(() => readTrack("x [furlong],y\n1,2\n"), /furlong/);
        assert.throws(() => readTrack("x [constructor],y\n1,2\n"), /line 1: "constructor"/);
        assert.throws(() => readTrack("# a film\n\nx,y\n1,1\n1,oops\n"), /line 5/);
        assert.throws(() => readTrack("x,y\n1e300,1\n2,3\n4,-1e300\n"), /line 2/);
        assert.throws(() => readTrack("x,y\n1,1\n1,1\n1,1\n"), /the same/);
        assert.throws(() => readTrack(`x${" ".repeat(1e6)}z,y\n1,1\n`), /three places/, "and at once");
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
        row[COLUMN.turns] = 3.25;
        const look = camera.look(row, 0.1, 1.5, 1, 34);
        assert.ok(Math.abs(look.eye[0]) < 1e-9 && Math.abs(look.eye[1]) < 1e-9 && look.eye[2] > 4);
        [-1, 0, 0].forEach((value, i) => assert.ok(Math.abs(look.up[i] - value) < 1e-9, "X of the magnet, now along Y, is to the right"));
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
    "presets and lesson say what runs say"() {
        const regimes = { locked: "locked", four: "counter-rotating", twelve: "counter-rotating", many: "counter-rotating", dry: "counter-rotating", discs: "counter-rotating" };
        for (const [id, regime] of Object.entries(regimes))
            assert.equal(ran({ ...PRESETS.find((preset) => preset.id === id).scene, "run.periods": 200 }).regime, regime, id);
        for (const step of LESSON) {
            assert.ok(step.answer >= 0 && step.answer < step.answers.length);
            core.setScene(step.scene);
        }
        const gear = ran({ "drive.frequency": 10.7 });
        assert.equal(gear.max_angle_deg.toFixed(1), "4.4");
        assert.equal(gear.festoons.toFixed(2), "4.19");
        const [at9, at10, at14, at20] = [9.1, 10.7, 14.5, 20].map((f) => ran({ "drive.frequency": f }));
        assert.ok(at9.mean_r < at10.mean_r && at10.mean_r < at14.mean_r, "the radius grows at first");
        assert.ok(Math.abs(at20.mean_r / at14.mean_r - 1) < 0.05 && at20.std_r < at14.std_r && at14.std_r < at10.std_r, "then it hardly changes");
        assert.equal(at14.festoons.toFixed(1), "12.2");
        const dry = ran({ "friction.law": "coulomb", "drive.frequency": 10.7 });
        assert.equal((100 * dry.sticking).toFixed(0), "37");
        assert.equal(dry.captures_per_return, 3);
    },
    "the page is one file of less than 1.1 MB with its version"() {
        const page = join(BUILD_DIR, "festoon-lab.html"), text = readFileSync(page, "utf8");
        assert.ok(statSync(page).size < 1.1e6);
        assert.ok(text.includes(`festoon ${core.version}, results version ${core.resultsVersion}`));
        assert.ok(!/<(?:script|link|img|iframe)[^>]+(?:src|href)="(?!data:)/.test(text), "nothing is loaded from anywhere");
    },
};

let failed = 0;
for (const [name, test] of Object.entries(tests)) {
    try {
        test();
        console.log(`ok: ${name}`);
    } catch (error) {
        failed += 1;
        console.log(`FAILED: ${name}\n${error.stack}`);
    }
}
process.exit(failed ? 1 : 0);
