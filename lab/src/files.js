/* files.js - what is saved from the page and opened in it.  A file from outside is text: its values go to the library,
 * which checks them, and its words are shown as text. */
import { element, sentence } from "./controls.js";
import { COLUMN } from "./core.js";
import { withMap } from "./magnet.js";
import { told, whole } from "./said.js";
import { readScene, readTrack, writeScene } from "./state.js";
import { say, T, Told } from "./texts.js";
import { readTrajectory } from "./trajectory.js";

/* Whether a table is a measured field, by the names of its columns, or a file that may be one. */
const isMap = (name, text) => /\.(h5|hdf5|vt[kir])$/i.test(name) || /^.{0,80}(^|[,;\t"# ])b[ _]?x\b/im.test(text.slice(0, 4000));

const SCENE = /\.ya?ml$/i, LONGEST_FILE = 60e6, FILM = /\.(webm|mp4|m4v|mov|avi|mkv|mpe?g|wmv|gif)$/i, DEGREES = 180 / Math.PI;

function save(name, blob) {
    const address = URL.createObjectURL(blob), link = element("a", { href: address, download: name });
    document.body.append(link);
    link.click();
    link.remove();
    setTimeout(() => URL.revokeObjectURL(address), 10000);
}

/* What a table of a motion has of each bead: a column's name, its unit, how it is read off a row. */
const seen = (s, recorded) => [["x", "mm", (row) => row[COLUMN.x] * s.mm], ["y", "mm", (row) => row[COLUMN.y] * s.mm], ...(recorded ? [["z", "mm", (row) => row[COLUMN.z] * s.mm]] : []),
    ["r", "mm", (row) => row[COLUMN.r] * s.mm], ["Phi", "deg", (row) => row[COLUMN.phi] * DEGREES], ...["nx", "ny", "nz"].map((name, k) => [name, "", (row) => row[COLUMN.n + k]]),
    ["B", s.tesla ? "mT" : "B0", (row) => row[COLUMN.field] * s.field],
    ...(recorded ? [] : ["slip_r", "slip_alpha"].map((name, k) => [name, "mm/s", (row) => row[COLUMN.slip + k] * s.speed])),
    ["load", "weights", (row) => row[COLUMN.load]], ...(recorded ? [] : [["sticks", "", (row) => row[COLUMN.sticks]]])];

/* The motion of each bead since it began to be shown, as `festoon run --csv --units lab` names it.  Of a recorded one,
 * which is of several beads or in a world, heights are told too; what its samples do not have, slip and sticking, is not. */
export function motionTable(trails, units, recorded) {
    const columns = seen(units, recorded), named = (name, i) => (trails.length > 1 ? `${name}_${i}` : name);
    const heads = ["t [s]", "turns", ...trails.flatMap((_, i) => columns.map(([name, unit]) => named(name, i) + (unit && ` [${unit}]`)))];
    const lines = trails[0].samples.map((row, at) => [row[COLUMN.time], row[COLUMN.turns],
        ...trails.flatMap(({ samples }) => columns.map(([, , read]) => read(samples[at])))].join());
    return `${heads.join()}\n${lines.join("\n")}\n`;
}

export class Files {
    constructor(lab) {
        this.lab = lab;
        this.listenDrops();
    }

    build() {
        const { lab } = this, box = document.getElementById("files"), add = (id, text, act) => {
            const button = element("button", { type: "button", id }, text);
            button.addEventListener("click", act);
            box.append(button);
            return button;
        };
        box.replaceChildren();
        add("save-csv", T.saveCsv, () => save("festoon-motion.csv", new Blob([motionTable(lab.trails, lab.units, Boolean(lab.recording))], { type: "text/csv" })));
        add("save-png", T.savePng, () => lab.view.canvas.toBlob((blob) => blob && save("festoon.png", blob)));
        if (window.MediaRecorder && HTMLCanvasElement.prototype.captureStream)
            this.film = add("save-film", this.recorder ? T.stopFilm : T.saveFilm, () => this.record());
        add("save-scene", T.saveScene, () => save("festoon.yaml", new Blob([this.sceneText()], { type: "text/yaml" })));
        add("copy", T.copy, () => this.copy());
        const input = element("input", { type: "file", id: "open", accept: ".yaml,.yml,.csv,.txt", multiple: true, hidden: true });
        input.addEventListener("change", () => this.openAll(input.files));
        add("open-button", T.open, () => input.click());
        box.append(input, element("p", { class: "help" }, T.openHelp));
    }

    sceneText() {
        return writeScene(this.lab.scene, "What differs from the default scene; festoon run reads this file.");
    }

    async copy() {
        try {
            await navigator.clipboard.writeText(location.href);
            this.lab.tell(T.copied);
        } catch {
            this.lab.tell(T.copyFailed);
        }
    }

    record() {
        if (this.recorder) {
            this.recorder.stop();
            return;
        }
        const pieces = [], recorder = new MediaRecorder(this.lab.view.canvas.captureStream(30));
        recorder.ondataavailable = (event) => pieces.push(event.data);
        recorder.onstop = () => {
            this.recorder = null;
            this.film.textContent = T.saveFilm;
            save("festoon.webm", new Blob(pieces, { type: "video/webm" }));
        };
        recorder.start();
        this.recorder = recorder;
        this.film.textContent = T.stopFilm;
    }

    listenDrops() {
        document.addEventListener("dragover", (event) => {
            event.preventDefault();
            document.body.classList.add("drop");
        });
        document.addEventListener("dragleave", () => document.body.classList.remove("drop"));
        document.addEventListener("drop", (event) => {
            event.preventDefault();
            document.body.classList.remove("drop");
            this.openAll(event.dataTransfer.files);
        });
    }

    /* Scenes come last, because they may name the maps among the files. */
    async openAll(files) {
        const isScene = ({ name }) => SCENE.test(name);
        for (const file of [...files].sort((a, b) => isScene(a) - isScene(b)))
            await this.open(file);
    }

    async open(file) {
        const { lab } = this, name = file.name.slice(0, 80);
        try {
            if (FILM.test(file.name) || /^video/.test(file.type))
                throw new Told(T.bad.film);
            if (file.size > LONGEST_FILE)
                throw new Told(T.bad.large);
            const text = await file.text();
            const trajectory = readTrajectory(text);
            const map = !trajectory && isMap(file.name, text);
            if (!map && text.includes("\0"))
                throw new Told(T.bad.binary);
            if (map) {
                const taken = lab.takeMap(name, new Uint8Array(await file.arrayBuffer()));
                this.openScene(name, this.sceneFor(taken), T.mapTaken);
            } else if (trajectory || SCENE.test(file.name)) {
                this.openScene(name, trajectory?.scene ?? readScene(text), trajectory ? T.replayed : T.opened, trajectory);
            } else {
                this.showTrack(readTrack(text));
            }
        } catch (error) {
            this.refuse(name, sentence(error));
        }
    }

    /* The scene that waited for this map, or the one that is open, with it. */
    sceneFor(map) {
        const { awaited, scene } = this.lab, waits = awaited?.["magnet.file"]?.split("/").at(-1) === map.name;
        this.lab.awaited = waits ? null : awaited;
        return waits && awaited["magnet.checksum"] ? awaited : withMap(waits ? awaited : scene, map);
    }

    /* The library may have named the file, and its line. */
    refuse(name, wrong) {
        this.lab.tell(wrong.startsWith(name) ? wrong : say(T.pair, { name, value: wrong }), true);
    }

    openScene(name, scene, news, trajectory = null) {
        const { lab } = this, view = { ...lab.viewWords(), "ui.ramp": "0", "ui.settle": "0" }; /* a scene begins at its own start */
        let wrong = null;
        lab.replace(() => {
            wrong = lab.open({ scene, view }, trajectory);
            if (!wrong)
                lab.lesson.close();
        });
        const doubt = wrong ? "" : lab.core.mapDoubt();
        if (wrong)
            this.refuse(name, wrong);
        else
            lab.tell([say(news, { name }), doubt && whole(told(doubt))].filter(Boolean).join(" "));
    }

    showTrack({ tracks, unit }) {
        const { lab } = this, points = tracks.flat(), beads = tracks.length, mean = (list) => list.reduce((sum, value) => sum + value, 0) / Math.max(1, list.length);
        let scale = 1 / lab.units.mm;
        if (unit === "px")
            scale = (mean(lab.trail.samples.map((row) => row[COLUMN.r])) || 0.8) / mean(points.map((p) => Math.hypot(...p)));
        lab.showTrack(tracks.map((line) => line.map((p) => [p[0] * scale, p[1] * scale])));
        lab.panels.chooseCamera("above");
        lab.tell(`${say(beads > 1 ? T.tracksShown : T.trackShown, { n: points.length, beads })}${unit === "px" ? ` ${T.trackInPixels}` : ""}`);
    }
}
