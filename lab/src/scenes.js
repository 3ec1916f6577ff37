/* scenes.js - the scenes of experiments and lesson: what differs from the default, and the view. */

/* Two upright discs of neodymium side by side, as many stirrers have them. */
function twoDiscs() {
    const scene = { "magnet.shape": "parts" };
    [1, -1].forEach((side, i) => {
        const part = `magnet.parts[${i}]`;
        Object.assign(scene, {
            [`${part}.kind`]: "cylinder", [`${part}.centre[0]`]: `${18 * side} mm`, [`${part}.centre[1]`]: "0 mm", [`${part}.centre[2]`]: "0 mm",
            [`${part}.size[0]`]: "15 mm", [`${part}.size[1]`]: "8 mm",
            [`${part}.remanence[0]`]: "0 T", [`${part}.remanence[1]`]: "0 T", [`${part}.remanence[2]`]: `${1.2 * side} T`,
        });
    });
    return scene;
}

/* A vector of a scene. */
const vector = (key, numbers) => Object.fromEntries(numbers.map((number, i) => [`${key}[${i}]`, number]));

/* A rotor of 19 mm whose moment is raised by 5 degrees, and a floater above it (docs/levitation.md). */
const LEVITATION = {
    "magnet.shape": "parts", "magnet.parts[0].kind": "sphere", ...vector("magnet.parts[0].centre", ["0", "0", "0"]), "magnet.parts[0].size[0]": "19 mm",
    ...vector("magnet.parts[0].remanence", ["1.2 T", "0", "0"]), ...vector("magnet.parts[0].rotation", ["5", "0", "-1", "0"]),
    "drive.frequency": "200 Hz", "bead.radius": "6.35 mm", "bead.density": "7500", "bead.remanence": "1.2 T", "plate.shape": "none", "plate.radius": "100 mm",
    "medium.drag_rate": "10 1/s", "medium.spin_drag_rate": "10 1/s", ...vector("start.position", ["0", "0", "23.021 mm"]), ...vector("start.n", ["0", "0", "1"]),
    "start.spin": "rest", "run.duration": "1.5 s", "run.samples": "32",
};
const WAVE = {
    "magnet.shape": "parts", "drive.waveform": "wave", "drive.frequency": "2 Hz", "wave.length": "60 mm", "wave.amplitude": "2 mT", "bead.radius": "2.5 mm", "bead.mass": "0.5 g",
    "bead.remanence": "1.2 T", "plate.radius": "10 m", ...vector("start.position", ["0", "0", "2.5 mm"]), "start.spin": "rest", "run.duration": "20 s",
};

/* The experiments, whose names are T.presetNames. */
export const PRESETS = [
    { id: "locked", settle: 30, scene: { "drive.frequency": "3 Hz" }, view: { "ui.slow": "5", "ui.camera": "free" } },
    { id: "four", settle: 200, scene: { "drive.frequency": "10.7 Hz" }, view: { "ui.slow": "20", "ui.camera": "free" } },
    { id: "twelve", settle: 200, scene: { "drive.frequency": "14.5 Hz" }, view: { "ui.slow": "20", "ui.camera": "above" } },
    { id: "many", settle: 200, scene: { "drive.frequency": "19.9 Hz" }, view: { "ui.slow": "50", "ui.camera": "above" } },
    { id: "critical", settle: 100, scene: { "drive.frequency": "8.3 Hz" },
        view: { "ui.slow": "5", "ui.camera": "above", "ui.ramp": "9.6" } },
    { id: "none", scene: { "friction.law": "none", "drive.frequency": "19.9 Hz" }, view: { "ui.slow": "20", "ui.camera": "above" } },
    { id: "dry", settle: 100, scene: { "friction.law": "coulomb", "drive.frequency": "10.7 Hz" },
        view: { "ui.slow": "50", "ui.camera": "bead", "ui.colour": "sticks", "ui.arrows": "friction" } },
    { id: "discs", settle: 100, scene: { ...twoDiscs(), "drive.frequency": "15 Hz" }, view: { "ui.slow": "50", "ui.camera": "free" } },
    { id: "walker", scene: { "drive.frequency": "30 Hz", "contact.pair_rate": "312.5 1/s", "beads[0].start.phi": "3 deg", "beads[1].start.phi": "40 deg",
        "run.periods": "100", "run.discard": "50" }, view: { "ui.slow": "30", "ui.camera": "free", "ui.trail": "4" } },
    { id: "opposite", scene: { "drive.frequency": "30 Hz", "beads[0].start.phi": "3 deg", "beads[1].start.phi": "183 deg", "run.periods": "100", "run.discard": "50" },
        view: { "ui.slow": "30", "ui.camera": "free", "ui.trail": "4" } },
    { id: "levitation", scene: LEVITATION, view: { "ui.slow": "100", "ui.camera": "free", "ui.trail": "20", "ui.arrows": "moment" } },
    { id: "bowl", scene: { "plate.shape": "bowl", "plate.bowl_radius": "150 mm", "start.r": "0.9", "run.periods": "100", "run.discard": "50" },
        view: { "ui.slow": "20", "ui.camera": "free", "ui.colour": "z" } },
    { id: "wave", scene: WAVE, view: { "ui.slow": "3", "ui.camera": "free", "ui.arrows": "moment" } },
];

/* The steps of the lesson, whose words are T.lesson.  `answer` is the place of the right one. */
export const LESSON = [
    { answer: 0, scene: { "drive.frequency": "3 Hz" }, view: { "ui.slow": "5", "ui.camera": "free" } },
    { answer: 2, settle: 100, scene: { "drive.frequency": "8.3 Hz" }, view: { "ui.slow": "5", "ui.camera": "above", "ui.ramp": "9.6" } },
    { answer: 1, settle: 200, scene: { "drive.frequency": "10.7 Hz" }, view: { "ui.slow": "100", "ui.camera": "bead", "ui.arrows": "moment,field" } },
    { answer: 1, settle: 200, scene: { "drive.frequency": "10.7 Hz" }, view: { "ui.slow": "20", "ui.camera": "magnet" } },
    { answer: 0, settle: 200, scene: { "drive.frequency": "14.5 Hz" }, view: { "ui.slow": "20", "ui.camera": "above" }, plot: "sweep", sweep: [9, 25, 33] },
    { answer: 1, settle: 100, scene: { "friction.law": "coulomb", "drive.frequency": "10.7 Hz" },
        view: { "ui.slow": "100", "ui.camera": "bead", "ui.colour": "sticks", "ui.arrows": "friction" } },
];
