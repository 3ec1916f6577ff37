/* texts.js - every word that the page shows, in one table: another language is another column. */

const EN = {
    title: "festoon lab",
    subtitle: "a magnetic bead on a magnetic stirrer",
    play: "Play", pause: "Pause", step: "Step", restart: "Restart",
    slow: "Slow motion", slowValue: (n) => (n === 1 ? "real time" : `${n} times slower`),
    slowTrue: (n, set) => `${n} times slower, not ${set === 1 ? "real time" : set}: this device is too slow`,
    screen: "Full screen", screenLeave: "Leave full screen",
    cameras: { above: "Above", free: "Free", magnet: "With the magnet", bead: "With the bead" },
    cameraHelp: {
        above: "From above, as a camera over the stirrer sees it.",
        free: "Drag to turn the view, pinch or use the wheel to come closer.",
        magnet: "You ride with the magnet: it stands still, and a festoon pattern becomes a closed loop.",
        bead: "You ride with the bead: watch its marks to see it roll, slip or stick.",
    },
    presets: "Experiments", details: "In detail",
    paper: (given) => `Set for this picture: ${given}.`, paperDefault: "All parameters have their defaults.",
    ramp: "Ramp", rampOn: (f) => `speeding up: ${f} Hz`,
    numbers: "What the bead does",
    wait: "computing …", waitShare: (percent) => `computing … ${percent} %`,
    settledLess: "The turns before the picture were cut short, because they took too long.",
    recordedEnd: "The run ends here. Play shows it again.",
    bead: (i) => `bead ${i}`,
    left: { edge: "The bead has left the plate. Press Restart.", lift: "The load on the plate has vanished: the bead jumps. Press Restart." },
    colour: "Colour of the trail", trailTurns: "Length of the trail (turns of the magnet)", arrows: "Arrows",
    arrowNames: { moment: "moment", field: "field", friction: "friction", load: "load" },
    quantities: {
        nz: "pole up or down (±1)", r: "distance r", field: "field |B|", slip: "slip of the contact", speed: "speed",
        load: "load on the plate", use: "use of static friction", sticks: "slips or sticks", angle: "angle of moment and field",
        spin: "spin about the moment", time: "time", z: "height of the centre",
    },
    plots: { phi: "Over the angle", sweep: "Over the speed", path: "Moment" },
    plotLabels: {
        phi: "angle Φ of the bead against the magnet (degrees)", r: "distance from the axis, r (mm)", nz: "north pole up (1) or down (−1), n_z", b: (unit) => `field, |B| (${unit})`,
        f: "turns of the magnet per second (Hz)", meanR: "mean distance ⟨r⟩ (mm)", nAlpha: "moment along the bead's circle", nUp: "moment upward, n_z",
        none: "Press Sweep to compute this curve",
    },
    sweep: "Sweep", sweepStop: "Stop", sweepFrom: "from (Hz)", sweepTo: "to (Hz)", sweepPoints: "points",
    sweepDone: (n, all) => `${n} of ${all} points`,
    parameters: "All parameters", main: "Main controls",
    view: "View", files: "Save and open",
    saveCsv: "Motion (CSV)", savePng: "Picture (PNG)", saveFilm: "Record film (webm)", stopFilm: "Stop recording", saveScene: "Scene (YAML)",
    open: "Open a scene or a track", openHelp: "Or drop a file anywhere on the page. A track is drawn in white over the model.",
    copy: "Copy the link", copied: "The link is in the clipboard.", copyFailed: "The link is in the address line.",
    trackShown: (n, unit) => `${n} places of the track are drawn in white, about the centre of their best circle${unit === "px" ? "; it is in pixels, so its size was matched to the model's trail" : ""}.`,
    unknown: (words) => `Not understood, so left out: ${words}.`,
    restTaken: "All else that the address says is set.",
    noMemory: "The browser gives this page no more memory. Close other pages, then load this one again.",
    opened: (name) => `${name} is open.`,
    failed: (name, why) => `${name}: ${why}`,
    lostWebgl: "The browser has lost the picture in three dimensions. Until it comes back the view is from above.",
    noWebgl: "This browser has no WebGL: the view is from above.",
    keys: "Keys: space plays and pauses, . makes a step, R begins anew, 1 to 4 choose the camera, 5 opens the lesson, F fills the screen. In the view the arrow keys turn it, + and − zoom.",
    viewLabel: "The bead on the plate, seen from the chosen camera",
    lesson: "Lesson", lessonOpen: "Open the lesson", lessonClose: "Close the lesson", back: "Back", next: "Next",
    names: {
        "bead.radius": "Radius of the bead", "bead.mass": "Mass of the bead", "bead.moment": "Moment of the bead", "bead.material": "Magnetic material",
        "bead.inertia": "Moment of inertia (in m R²)", "bead.density": "Density of the bead", "bead.remanence": "Remanence of the bead",
        "bead.a": "Magnetisability a", "bead.b": "Magnetisability b", "magnet.shape": "Kind of magnet", "magnet.half_length": "Half length l",
        "magnet.width": "Width", "magnet.depth": "Depth of the magnet", "magnet.lines": "Lines of dipoles", "magnet.b0": "Field unit B₀",
        "drive.frequency": "Speed of the magnet", "drive.omega": "Speed, scaled", "friction.law": "Law of friction", "friction.gamma": "Viscous rate γ",
        "friction.mu": "Coefficient, dry μ", "friction.mu_static": "Static coefficient", "friction.stribeck_speed": "Stribeck speed",
        "friction.rolling_resistance": "Rolling resistance", "contact.patch": "Contact patch",
        "contact.radius": "Radius of the patch", "contact.modulus": "Contact modulus", "impact.restitution": "Bounce", "model.dynamics": "Equations",
        "model.kappa": "Magnetic strength κ", "model.eps": "Scaled radius ε", "model.h": "Scaled height h", "model.lambda": "Scaled spacing λ",
        "plate.radius": "Radius of the plate", "plate.gravity": "Gravity", "start.r": "Start: distance (in half lengths l)", "start.phi": "Start: angle Φ", "start.spin": "Start: spin",
        "run.periods": "Turns of a run", "run.discard": "Turns left out", "run.rtol": "Tolerance", "run.samples": "Samples a turn", "run.until": "End of a run",
    },
    choices: {
        "bead.material": { hard: "permanent magnet", paramagnetic: "magnetisable", mixed: "both" },
        "magnet.shape": { lines: "bar (lines of dipoles)", parts: "magnets of a scene", grid: "measured map" },
        "friction.law": { viscous: "viscous, like syrup", none: "none", coulomb: "dry: slips, sticks", rolling: "rolls, never slips" },
        "contact.patch": { point: "a point", hertz: "a disc (Hertz)" },
        "model.dynamics": { rigid: "a rigid sphere's", farago2020: "as printed in 2020" },
        "start.spin": { rolling: "rolling", rest: "at rest" },
        "run.until": { periods: "all its turns", settled: "when it repeats" },
    },
    groups: { bead: "Bead", magnet: "Magnet", drive: "Drive", friction: "Friction", contact: "Contact", impact: "Impact", model: "Model", plate: "Plate", start: "Start", run: "Run" },
    about: (name) => `About: ${name}`, slider: (name) => `${name}, slider`, notGiven: (unit) => (unit ? `not given, in ${unit}` : "not given"),
    predict: "Predict", observe: "Observe", explain: "Explain",
    lessonStep: (i, n) => `Step ${i} of ${n}`,
    right: "That is what you will see.", wrong: "Look closely: it does something else.",
    show: "Show me", why: "Why?",
    ring: "rings: 10 mm",
    live: (turns, seconds) => `turn ${turns} · ${seconds} s`,
    rows: {
        mean_r: "mean distance from the axis", std_r: "swing of the distance (root mean square)", bead: "bead circles", festoons: "festoons a lap", angle: "moment against field, at most",
        sticking: "contact at rest", symmetry: "symmetry", slip: "slip of the contact (root mean square)", height: "mean height over the rotor's middle", velocity: "mean velocity along the wave", touching: "in touch at the end", impacts: "lost in impacts",
    },
    symmetries: { S1: "one pole draws the path (S1)", S2: "both poles alike draw it (S2)" },
    against: "against the magnet", along: "with the magnet", or: "or",
    regimes: {
        locked: (m) => `Locked: the bead turns with the magnet, ${m.r} mm from the axis.`,
        librating: (m) => `Librating: the bead goes with the magnet and swings about it, mean distance ${m.r} mm.`,
        "counter-rotating": (m) => `Counter-rotating: the bead circles against the magnet, once every ${m.turns} turns${m.festoons === null ? "" : `, and draws ${m.festoons} festoons a lap`}.`,
        corotating: (m) => `Corotating: the bead circles slowly with the magnet, which overtakes it, once every ${m.turns} turns.`,
        chaotic: (m) => `Chaotic: the motion never repeats itself, mean distance ${m.r} mm.`,
        levitating: () => "Levitating: it floats, and nothing touches it.",
        touched: () => "Touched: it falls on the magnet.",
        lost: () => "Lost: it flies away.",
        backward: () => "Backward: the bead rolls against the wave, and its moment turns with the field below it.",
        forward: () => "Forward: the bead rolls with the wave, and its moment turns with the field from above.",
        drifting: () => "Drifting: the wave runs on under the bead, which keeps to none of its fields.",
        ejected: () => "Ejected: the bead leaves the plate.",
        lifted: () => "Lifted: the load vanishes and the bead jumps, which this model does not follow.",
        undecided: (m) => (m.oneOff ? "This drive leaves the bead no name for what it does." : m.free ? `Without friction nothing calms the bead: it wanders, ${m.r} mm from the axis on average, and never forgets how it began.`
            : "Undecided: this run does not show what the motion is; a longer one may."),
    },
};

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

/* An experiment: scene and view. */
export const PRESETS = [
    { id: "locked", settle: 30, name: "Locked, 3 Hz", scene: { "drive.frequency": "3 Hz" }, view: { "ui.slow": "5", "ui.camera": "free" } },
    { id: "four", settle: 200, name: "10.7 Hz: four festoons", scene: { "drive.frequency": "10.7 Hz" }, view: { "ui.slow": "20", "ui.camera": "free" } },
    { id: "twelve", settle: 200, name: "14.5 Hz", scene: { "drive.frequency": "14.5 Hz" }, view: { "ui.slow": "20", "ui.camera": "above" } },
    { id: "many", settle: 200, name: "19.9 Hz: many festoons", scene: { "drive.frequency": "19.9 Hz" }, view: { "ui.slow": "50", "ui.camera": "above" } },
    { id: "critical", settle: 100, name: "Critical speed: a ramp", scene: { "drive.frequency": "8.3 Hz" },
        view: { "ui.slow": "5", "ui.camera": "above", "ui.ramp": "9.6" } },
    { id: "none", name: "No friction", scene: { "friction.law": "none", "drive.frequency": "19.9 Hz" }, view: { "ui.slow": "20", "ui.camera": "above" } },
    { id: "dry", settle: 100, name: "Dry friction: slip and stick", scene: { "friction.law": "coulomb", "drive.frequency": "10.7 Hz" },
        view: { "ui.slow": "50", "ui.camera": "bead", "ui.colour": "sticks", "ui.arrows": "friction" } },
    { id: "discs", settle: 100, name: "Two real magnets, 15 Hz", scene: { ...twoDiscs(), "drive.frequency": "15 Hz" }, view: { "ui.slow": "50", "ui.camera": "free" } },
    { id: "walker", name: "Two beads: a walker", scene: { "drive.frequency": "30 Hz", "contact.pair_rate": "312.5 1/s", "beads[0].start.phi": "3 deg", "beads[1].start.phi": "40 deg",
        "run.periods": "100", "run.discard": "50" }, view: { "ui.slow": "30", "ui.camera": "free", "ui.trail": "4" } },
    { id: "opposite", name: "Two beads, opposite", scene: { "drive.frequency": "30 Hz", "beads[0].start.phi": "3 deg", "beads[1].start.phi": "183 deg", "run.periods": "100", "run.discard": "50" },
        view: { "ui.slow": "30", "ui.camera": "free", "ui.trail": "4" } },
    { id: "levitation", name: "Levitation", scene: LEVITATION, view: { "ui.slow": "100", "ui.camera": "free", "ui.trail": "20", "ui.arrows": "moment" } },
    { id: "bowl", name: "In a bowl", scene: { "plate.shape": "bowl", "plate.bowl_radius": "150 mm", "start.r": "0.9", "run.periods": "100", "run.discard": "50" },
        view: { "ui.slow": "20", "ui.camera": "free", "ui.colour": "z" } },
    { id: "wave", name: "A travelling field", scene: WAVE, view: { "ui.slow": "3", "ui.camera": "free", "ui.arrows": "moment" } },
];

/* The lesson: each step a state, a question with answers, what to look at, and why it is so.  `answer` is the place
 * of the right one. */
export const LESSON = [
    {
        title: "A slow magnet",
        scene: { "drive.frequency": "3 Hz" }, view: { "ui.slow": "5", "ui.camera": "free" },
        question: "Below the glass plate a bar magnet turns, three times a second. On the plate lies a magnetic bead. What does the bead do?",
        answers: ["It goes round with the magnet.", "It stays where it is.", "It goes round the other way."], answer: 0,
        observe: "The bead sits over a pole of the bar and is carried along. Choose “With the magnet”: there the bead stands still.",
        explain: "The pole attracts the bead more strongly than friction holds it back. Seen from the turning bar the bead is at rest: it is locked. The bead's own moment, which points from its blue end to its red one, follows the field of the bar.",
    },
    {
        title: "A faster magnet", settle: 100,
        scene: { "drive.frequency": "8.3 Hz" }, view: { "ui.slow": "5", "ui.camera": "above", "ui.ramp": "9.6" },
        question: "Now the magnet speeds up slowly, from 8.3 to 9.6 turns a second. What will the bead do in the end?",
        answers: ["It goes round faster and faster with the magnet.", "It is thrown off the plate.", "It turns back and goes round against the magnet."], answer: 2,
        observe: "Watch the trail, and the frequency in the corner of the picture. At first the bead goes with the magnet and swings. Near 8.9 turns a second its path passes through the axis – and then it runs backwards.",
        explain: "This is the critical speed: 8.90 Hz, 534 turns a minute. Somebody who rides with the magnet sees the bead run round a loop. Below the critical speed the axis lies outside the loop: the bead swings about its pole and is taken along. Above it the loop goes round the axis. Each time the bead falls back by a whole turn, and that takes less than one turn of the magnet: so it runs backwards.",
    },
    {
        title: "A gear wheel", settle: 200,
        scene: { "drive.frequency": "10.7 Hz" }, view: { "ui.slow": "100", "ui.camera": "bead", "ui.arrows": "moment,field" },
        question: "The bead runs against the magnet. Slow motion shows how: you ride with the bead. What does the bead do on the plate?",
        answers: ["It slides and does not turn.", "It rolls, turned over by the field.", "It spins on the spot like a top."], answer: 1,
        observe: "The yellow arrow is the bead's moment, the blue one the field. They stay together, and each time the bar passes below both turn over. Watch the marks: the bead rolls.",
        explain: "The bar slips away below the bead, so the field at the bead's place turns over and over. The moment follows the field, here to 4.4 degrees. So the bead is turned like a gear wheel driven from below, and a ball that turns on a plate rolls: against the bar.",
    },
    {
        title: "Garlands", settle: 200,
        scene: { "drive.frequency": "10.7 Hz" }, view: { "ui.slow": "20", "ui.camera": "magnet" },
        question: "From above the bead draws garlands, festoons: about four a lap. How does the path look for somebody who rides with the magnet?",
        answers: ["Just as knotted.", "As a closed loop.", "As a straight line."], answer: 1,
        observe: "The magnet stands still now, and the plate turns below. The bead draws the same loop again and again. Switch between “Above” and “With the magnet”.",
        explain: "In the magnet's frame nothing changes with time, so the bead may repeat itself exactly: a periodic orbit. The number of festoons counts how often the loop is run through while the bead goes once round the plate: 4.19, so the pattern seen from above does not close after one lap.",
    },
    {
        title: "How far out?", settle: 200,
        scene: { "drive.frequency": "14.5 Hz" }, view: { "ui.slow": "20", "ui.camera": "above" }, plot: "sweep", sweep: [9, 25, 33],
        question: "At 10.7 Hz the mean distance from the axis is 17.6 mm. What becomes of it when the magnet turns faster?",
        answers: ["It grows at first, then hardly changes.", "It shrinks to nothing.", "It stays the same at any speed."], answer: 0,
        observe: "The curve ⟨r⟩ over the speed is computed now, by the very program that physicists use: coarse points first, then finer ones.",
        explain: "Just above the critical speed one pole of the bar draws large festoons near the axis. From about 13.4 Hz on both poles draw small ones, twice as many: 12.2 a lap at 14.5 Hz. The swings become smaller, and the path comes near a circle of 20 mm: there, over the poles of the bar, the field is strongest.",
    },
    {
        title: "Slip and stick", settle: 100,
        scene: { "friction.law": "coulomb", "drive.frequency": "10.7 Hz" },
        view: { "ui.slow": "100", "ui.camera": "bead", "ui.colour": "sticks", "ui.arrows": "friction" },
        question: "So far friction was like syrup: the faster the slip, the greater the force. Real plates rub dry: a contact sticks until the push is too great. Does the bead still run against the magnet?",
        answers: ["No, dry friction stops it.", "Yes, and its contact sticks and slips in turn.", "Yes, but it never rolls, it only slides."], answer: 1,
        observe: "The trail is light where the contact sticks and dark where it slips. The orange arrow is the friction force.",
        explain: "For 37 percent of the time the contact sticks, and the bead rolls like a wheel. Three times in each loop the push on the contact becomes too great, and it slips until the speeds match again. The sense of the motion is the same as before, because it comes from the gear, not from the law of friction.",
    },
];

const LANGUAGES = { en: EN };
export const T = LANGUAGES[(typeof navigator === "object" && navigator.language?.slice(0, 2)) || "en"] || EN;
