/* said.mjs - the library's sentences in the languages of the page: what a user of the page can be told is in words of the
 * page's language, never in English.  node.mjs runs these tests. */
import assert from "node:assert/strict";
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { sentence } from "../src/controls.js";
import { told } from "../src/said.js";
import { PRESETS } from "../src/scenes.js";
import { SAID, speak, TABLES } from "../src/texts.js";

const { SOURCE_DIR } = process.env, OTHERS = Object.keys(TABLES).filter((language) => language !== "en"), MARKED = /\ue000/;

/* Do something in each language but English. */
function inEach(act) {
    try {
        for (const language of OTHERS) {
            speak(language);
            act(language);
        }
    } finally {
        speak("en");
    }
}

/* The texts of a C source, pieces joined. */
const textsOf = (path) => [...readFileSync(path, "utf8").replace(/\/\*[^]*?\*\//g, "").matchAll(/(?:"(?:[^"\\\n]|\\.)*"\s*)+/g)]
    .map(([all]) => [...all.matchAll(/"((?:[^"\\\n]|\\.)*)"/g)].map((piece) => piece[1]).join("").replace(/\\"/g, '"'));
const sources = (...rooms) => rooms.flatMap((room) => readdirSync(join(SOURCE_DIR, ...room.split("/"))).filter((name) => name.endsWith(".c")).map((name) => join(SOURCE_DIR, ...room.split("/"), name)));

/* All of whose sentences a run on the page can end in; pieces of longer ones, and what needs a call of C, are left out. */
const TELLING = ["study/regime.c", "study/conclude.c", "beads/seen.c", "beads/world_run.c", "beads/events.c", "beads/flow.c", "ode/flow.c", "model/start.c", "model/surroundings.c", "model/waveform.c"];
const LEFT_OUT = /^(; festoons|; whether the contact slips|stays at the axis$|at %.4g, %.4g l|the axis of %d beads|this computation takes one bead|the distance from the axis of)|out of memory/;

/* Patterns that no single text of C holds, because the library puts their sentences together. */
const MADE = /^(rangeInteger|noRemanence|noMoment|placeBeyond|chain|chainAtAxis|paradox|paradoxDry|mapTwice|mapCurl|mapCurlLittle|oneBead|onePart|oneSample|cluster|alone|oneApart|manyApart|oneEjected|manyEjected|oneGone|manyGone|turnsAxis|rateAxis)$/;

export const scripts = {
    "every sentence in which a run ends has words in each language"() {
        const given = TELLING.flatMap((file) => textsOf(join(SOURCE_DIR, "src", ...file.split("/")))).filter((text) => / .* /.test(text) && !LEFT_OUT.test(text))
            .map((text) => text.replace(/%[\d.]*(?:ll)?[dgcs]/g, (place) => (place.endsWith("s") ? "x" : "1")));
        assert.ok(given.length > 60);
        inEach((language) => given.forEach((text) => assert.ok(["sentences", "words"].some((table) => !MARKED.test(told(text, table))), `${language}: ${text}`)));
    },
    "each pattern is a sentence that the library has"() {
        const all = [...sources("src/base", "src/model", "src/ode", "src/study", "src/beads", "src/io", "lab").flatMap(textsOf), readFileSync(join(SOURCE_DIR, "include", "festoon", "lists.def"), "utf8"), readFileSync(join(SOURCE_DIR, "lab", "src", "core.js"), "utf8")].join("\n");
        for (const [table, patterns] of Object.entries(SAID.en))
            for (const [name, text] of Object.entries(patterns)) {
                const longest = text.split(/\{\w+\}|"/).sort((a, b) => b.length - a.length)[0].trim();
                assert.ok(MADE.test(name) || longest.length < 4 || all.includes(longest), `${table}.${name}: no C source has "${longest}"`);
            }
    },
    "a sentence that has no words is marked, with nothing lost; values keep their places, and numbers the language's sign"() {
        speak("de");
        try {
            assert.equal(told("the moon is full"), "\ue000the moon is full\ue001");
            assert.equal(told("\ue001the moon\ue000 is full"), "\ue000the moon is full\ue001", "marks from outside are not marks");
            assert.equal(told("bead.radius = 2.5 is out of range: it must be 0.0001 mm to 1000 mm, and 2.5 without a unit is 2.5 m; did you mean 2.5 mm?"),
                "bead.radius = 2,5 liegt außerhalb des Bereichs von 0,0001 mm bis 1000 mm, und 2,5 ohne Einheit bedeutet 2,5 m; war 2,5 mm gemeint?");
            assert.equal(told("magnet.parts[0].size[0] = 0 mm is out of range: it must be 0.001 mm to 10000 mm (a cuboid has three sizes, its edges)"),
                "magnet.parts[0].size[0] = 0 mm liegt außerhalb des Bereichs von 0,001 mm bis 10000 mm (ein Quader hat drei Maße, seine Kanten)");
            assert.equal(told("a pair turns with the magnet, and its centre walks against it, one bead apart: undecided", "pieces"),
                "ein Paar dreht sich mit dem Magneten, und sein Mittelpunkt läuft dem Magneten entgegen, eine Kugel getrennt: unentschieden");
            assert.ok(MARKED.test(told("a wheel turns with the magnet", "pieces")));
            const error = (where, message) => sentence(Object.assign(new Error(message), { where }));
            assert.equal(error("start.r", "start.n is not a direction: it has the length 0"), "start.r: start.n ist keine Richtung: Seine Länge ist 0");
            assert.equal(error("start.n", "start.n is not a direction: it has the length 0"), "start.n ist keine Richtung: Seine Länge ist 0", "its key is said once");
            assert.equal(error("t = 2.5", "the moon is full"), "der Zeit t = 2,5: \ue000the moon is full\ue001");
        } finally {
            speak("en");
        }
        assert.equal(told("the moon is full"), "the moon is full", "in English nothing is marked");
    },
};

const two = (rest) => ({ "beads[0].start.phi": "3 deg", "beads[1].start.phi": "40 deg", "drive.frequency": "30 Hz", ...rest });
const part = (kind, rest = {}) => ({ "magnet.shape": "parts", "magnet.parts[0].kind": kind, ...rest });
const sphere = { "magnet.parts[0].size[0]": "5 mm", "magnet.parts[0].remanence[0]": "1 T" };
const preset = (id) => PRESETS.find((found) => found.id === id).scene, levitation = preset("levitation"), wave = preset("wave");
const long = "y".repeat(300), stepping = { "run.method": "stepping" }, coulomb = { "friction.law": "coulomb" };

/* What contradicts itself, misses something, or is nowhere. */
const BAD = [
    { "bead.remanence": "1 T" }, part("sphere", { ...sphere, "magnet.b0": "1e-12 T" }), { ...coulomb, "friction.mu": 0.5, "friction.mu_static": 0.1 }, { ...coulomb, "contact.patch": "hertz" },
    { ...coulomb, "contact.radius": "1 mm" }, { ...coulomb, "friction.stribeck_speed": "1 mm/s" }, { "run.periods": 10, "run.discard": 20 }, { "run.duration": "1 s", "run.discard": 1e6 },
    { "plate.shape": "bowl" }, { "plate.shape": "bowl", "plate.bowl_radius": "1 mm" }, { "plate.shape": "bowl", "plate.bowl_radius": "50 mm", "start.r": 5 }, { "plate.gravity": -1 },
    { "medium.viscosity": "1 mPa s", "medium.drag_rate": "1 1/s" }, { "medium.viscosity": "1 mPa s", "medium.spin_drag_rate": "1 1/s" }, { "medium.density": 1000, "medium.drag_coefficient": 1, "medium.quadratic_drag": "1 1/m" },
    { "medium.added_mass": 1 }, { "field.uniform[0]": "1 mT" }, { "drive.waveform": "wave" }, { ...wave, "world.frame": "turning" }, { "world.frame": "turning", "plate.tilt": "3 deg" },
    ...["x", "0:0 1:2 0.5:3", "0:0"].map((table) => ({ "drive.waveform": "table", "drive.table": table })), { "drive.waveform": "table" }, { "plate.shape": "none" }, { "plate.shape": "none", "plate.tilt": "3 deg" }, { ...levitation, "friction.mu": 0.3 },
    two({ ...stepping, "run.step": 0.5 }), two({ ...stepping, "plate.shape": "bowl", "plate.bowl_radius": "100 mm" }), two({ ...stepping, "plate.tilt": "2 deg" }), { "run.method": "splitting" },
    ...["cuboid", "cylinder", "sphere", "cone"].map((kind) => part(kind)), part("dipole", { "magnet.parts[0].remanence[0]": "1 T" }), part("dipole", { "magnet.parts[0].size[0]": "1 mm" }), part("sphere", { "magnet.parts[0].moment[0]": 1 }),
    part("sphere", { "magnet.parts[0].size[1]": "1 mm" }), part("cylinder", { "magnet.parts[0].size[2]": "1 mm" }), part("sphere", { ...sphere, "magnet.parts[0].rotation[0]": 10 }), part("sphere", { ...sphere, "magnet.parts[0].motion": "x" }),
    part("sphere", { ...sphere, "magnet.parts[0].size[0]": "50 mm" }), part("sphere", { ...sphere, "magnet.shape": "lines" }), part("sphere", { ...sphere, "magnet.lines": 7 }), part("sphere", { ...sphere, "magnet.width": "5 mm" }),
    { "magnet.shape": "parts" }, part("sphere", { "magnet.parts[3].kind": "sphere" }), { "magnet.parts[0].size[0]": 1 },
    ...["magnet.parts[0].foo", "magnet.parts[99].kind", "magnet.parts", "coils[0].foo", "coils[99].radius", "coils", "beads[0].foo", "beads[99].start.phi", "beads", "foo", "drive.freqency", "friction.contact_rate", "run.controller", "<b>x</b> y", long].map((key) => ({ [key]: 1 })),
    { "contact.patch": "pade" }, { "coils[1].radius": 1 }, { "coils[0].current": 1 }, { "coils[0].radius": "1 m", "coils[0].axis[0]": 0, "coils[0].axis[1]": 0, "coils[0].axis[2]": 0, "magnet.b0": "1 mT" },
    { "start.r": 50 }, { "start.position[0]": "9 m", "start.position[2]": "2.5 mm" }, { "start.r": 0 }, { ...levitation, "start.position[2]": "1 mm" }, two({ "beads[0].start.n[0]": 0 }),
    two({ "beads[0].start.position[0]": "20 mm", "beads[0].start.position[2]": "-5 mm" }), two({ "beads[1].start.phi": "4 deg" }), { "beads[3].start.phi": 1 }, { "beads[0].start.phi": 1, "beads[3].start.phi": 1 },
    two({ "friction.law": "rolling" }), two({ "model.dynamics": "farago2020" }), two({ "magnet.shape": "grid", "magnet.file": "x.csv" }), two({ "bead.material": "mixed" }), two({ "beads[1].bead.a": 1 }),
    two({ ...coulomb, "friction.rolling_resistance": 0.01 }), two({ ...coulomb, "contact.pair_rate": "3 1/s" }), two({ "bead.moment": "1 A m^2", "beads[1].bead.moment": "0.1 A m^2" }), { "contact.pair_rate": 3 }, { "model.chi": 1 }, stepping,
    { "magnet.shape": "grid" }, { "magnet.shape": "grid", "magnet.file": "x.csv" }, { "magnet.file": "x.csv" }, { "magnet.file": long }, { "magnet.file": "a\u0001b" },
    { "drive.velocity[0]": 1 }, { "drive.amplitude": "3 deg" }, { "bead.b": 1, "bead.material": "paramagnetic" },
];
/* Maps that are none, by name; each grid of 8 x 8 but for what is bad of it. */
const grid = (cell = () => "1", places = [-4, -3, -2, -1, 0, 1, 2, 3]) => places.flatMap((y, j) => places.map((x, i) => `${x},${y},${cell(i, j)},0,0`)), table = (rows, head = "x [mm],y [mm],Bx [mT],By [mT],Bz [mT]") => [head, ...rows].join("\n");
const MAPS = [
    ["", "m.csv"], [table([]), "m.csv"], [table(grid().slice(1)), "m.csv"], [table([...grid(), "0,0,1,1,1"]), "m.csv"], [table(grid((i, j) => (i + j ? "1" : "oops"))), "m.csv"], [table(grid((i, j) => (i + j ? "1" : ""))), "m.csv"],
    [table(grid((i, j) => (i + j ? "1" : "1e400"))), "m.csv"], [table(grid((i, j) => (i + j ? "1" : "1e12"))), "m.csv"], [table(grid(undefined, [-4, -3, -2, -1, 0, 1, 2, 5])), "m.csv"], [table(grid(undefined, [1, 2, 3, 4, 5, 6, 7, 8])), "m.csv"],
    [table(grid(undefined, [-1, 0, 1])), "m.csv"], [table(["1,2,3", "4,5,6"]), "m.csv"], [table(["1,2,3,4,5,6"]), "m.csv"], [table(["1,1,1,1,1", "2,3,1,1,1", "5,7,1,1,1"]), "m.csv"],
    [table(grid(), "x [mm],y [mm],Bx [mT],By [mT]"), "m.csv"], [table(grid(), "x,y [mm],Bx [mT],By [mT],Bz [mT]"), "m.csv"], [table(grid(), "x [mm],y [mm],Bx [furlong],By [mT],Bz [mT]"), "m.csv"], [table(grid(), "x [mm],y [mm],Bx [mT],Bx [mT],By [mT],Bz [mT]"), "m.csv"], ["x", "m.h5"], ["# vtk", "m.vtk"],
    [`${"1,".repeat(2000)}\n`, "m.csv"],
];
const VALUES = ["", "x", "1e400", "-1e9", "0", "1e9", "2.5", "1,5", "1,000.5", "12 parsec", "12 mm", long];
const AXES = ["2:30:x", "x:30:3", "2:30:1e9", ":30:5", "2 3:30:5", "-1:30:5", "2:30:3:x", "2,3:30:5", "2:30:200000"];
/* Runs that end in sentences of all kinds, and are short. */
const RUNS = [{}, { "drive.frequency": 3 }, { "drive.frequency": 14.5 }, { "friction.law": "none" }, { "friction.law": "coulomb" }, { "run.rtol": 1e-3, "drive.frequency": 3 }, { "plate.radius": "25 mm" }, { "run.periods": 1, "run.discard": 0.5 }, { "model.kappa": 6, "drive.frequency": 40 },
    preset("walker"), { ...preset("opposite"), "beads[2].start.r": 0.1 }, { "plate.shape": "bowl", "plate.bowl_radius": "150 mm" }].map((scene) => ({ "run.periods": 20, "run.discard": 10, ...scene, ...("beads[0].start.phi" in scene ? { "run.periods": 3, "run.discard": 1 } : {}) }));

export const library = (core) => ({
    "no sentence about a bad value, a bad scene or a run is English in another language"() {
        const errors = new Map(), hear = (act) => {
            try {
                act();
                return false;
            } catch (error) {
                errors.set(`${error.where}|${error.message}`, error);
                return true;
            }
        };
        for (const { key } of core.parameters)
            assert.ok(VALUES.map((value) => hear(() => core.setScene({ [key]: value }))).includes(true), `${key} takes anything`);
        for (const scene of BAD)
            assert.ok(hear(() => core.setScene(scene)), `${JSON.stringify(scene)} is no longer refused`);
        core.setScene({});
        for (const axis of AXES)
            assert.ok(hear(() => core.grid(`drive.frequency=${axis}`)), axis);
        for (const [text, name] of MAPS)
            assert.ok(hear(() => core.readMap({ name, bytes: new TextEncoder().encode(text) })), `${name}: ${text.slice(0, 99)}`);
        core.readMap({ name: "flat.csv", bytes: new TextEncoder().encode(table(grid((i, j) => String(i * j)))) });
        const measured = { "magnet.shape": "grid", "magnet.file": "flat.csv", "bead.remanence": "1.2 T", "start.r": 0.12 };
        core.setScene(measured);
        const doubt = core.mapDoubt();
        assert.match(doubt, /has a curl of/);
        for (const scene of [{ "magnet.file": "other.csv" }, { "magnet.checksum": "0123456789abcdef" }, { "friction.law": "coulomb", "impact.restitution": 0.5 }])
            assert.ok(hear(() => core.setScene({ ...measured, ...scene })), JSON.stringify(scene));
        core.setScene({});
        assert.ok(errors.size > 600, String(errors.size));
        const found = RUNS.flatMap((scene) => {
            core.setScene(scene);
            const { reason, sentence: first } = core.run();
            return [[reason, "sentences"], ...(first ? [[first, "pieces"]] : [])];
        }).filter(([text]) => text);
        core.setScene({});
        assert.ok(found.length >= RUNS.length);
        inEach((language) => {
            for (const error of errors.values()) {
                const text = sentence(error);
                assert.ok(!MARKED.test(text), `${language}: ${text}`);
                assert.ok(!/\{\w+\}|undefined/.test(text), text);
            }
            for (const [text, table] of [...found, [doubt, "sentences"]])
                assert.ok(!MARKED.test(told(text, table)), `${language}: ${text}`);
        });
    },
});
