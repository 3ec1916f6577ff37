/* browser.mjs - the page in a real browser without a head, opened from its file as a double click does.  Started by
 * tests/lab/test_lab_long.py, which sets FESTOON, SOURCE_DIR, BUILD_DIR and CHROMIUM.  With PICTURES=FOLDER every state is
 * left there as a picture, to be looked at. */
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";
import puppeteer from "puppeteer-core";
import { TABLES } from "../src/texts.js";
import { goldenHashes } from "./golden.mjs";

const { FESTOON, SOURCE_DIR, BUILD_DIR, CHROMIUM, PICTURES } = process.env;
const PAGE = `file://${join(BUILD_DIR, "festoon-lab.html")}`, AXE = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
const SIZES = { wide: { width: 1000, height: 800 }, narrow: { width: 360, height: 640, isMobile: true, hasTouch: true } };
const scratch = mkdtempSync(join(tmpdir(), "festoon-lab-"));
const browser = await puppeteer.launch({
    executablePath: CHROMIUM, headless: true, userDataDir: join(scratch, "profile"), protocolTimeout: 600000,
    args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
});
const festoon = (...words) => execFileSync(FESTOON, words, { encoding: "utf8", stdio: ["ignore", "pipe", "pipe"] });

/* A page that is ready, with all that it asked for and complained of. */
async function open(hash = "", { size = SIZES.wide, flat = false, reduced = false, counted = false, languages = ["en"] } = {}) {
    const page = await browser.newPage();
    page.asked = [];
    page.complaints = [];
    await page.setViewport(size);
    page.on("request", (request) => page.asked.push(request.url()));
    page.on("pageerror", (error) => page.complaints.push(error.message));
    page.on("console", (message) => ["error", "warn"].includes(message.type()) && !/GL Driver|GPU stall|WebGL/.test(message.text()) && page.complaints.push(message.text()));
    await page.evaluateOnNewDocument((list) => Object.defineProperty(navigator, "languages", { value: list }), languages);
    if (reduced)
        await page.emulateMediaFeatures([{ name: "prefers-reduced-motion", value: "reduce" }]);
    if (flat)
        await page.evaluateOnNewDocument(() => {
            const usual = HTMLCanvasElement.prototype.getContext;
            HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
                return /webgl/.test(kind) ? null : usual.call(this, kind, ...rest);
            };
        });
    if (counted)
        await page.evaluateOnNewDocument(() => {
            window.callbacks = 0;
            for (const name of ["requestAnimationFrame", "setTimeout", "setInterval"]) {
                const usual = window[name];
                window[name] = (call, ...rest) => usual.call(window, (...what) => {
                    window.callbacks += 1;
                    call(...what);
                }, ...rest);
            }
        });
    await page.goto(PAGE + hash);
    await page.evaluate(() => window.festoonLab.ready.then(() => true));
    return page;
}

async function close(page) {
    const foreign = page.asked.filter((url) => !url.startsWith(PAGE) && !/^(blob:|data:)/.test(url));
    await page.close();
    assert.deepEqual(foreign, [], "nothing is asked of any network");
    assert.deepEqual(page.complaints, []);
}

async function picture(page, name) {
    if (PICTURES)
        await page.screenshot({ path: join(PICTURES, `${name}.png`) });
}

/* Wait until the page's run is described. */
const described = (page) => page.waitForFunction(() => !/computing|^$/.test(document.getElementById("regime").textContent), { timeout: 0 });
const type = (page, selector, text) => page.$eval(selector, (field, value) => {
    field.value = value;
    field.dispatchEvent(new Event("change", { bubbles: true }));
}, text);
const click = (page, selector) => page.$eval(selector, (element) => element.click());

/* How many different colours the view shows, in a coarse picture of it. */
const coloursOfView = (page, how = "draw") => page.evaluate((act) => {
    const { lab } = window.festoonLab, small = document.createElement("canvas");
    small.width = small.height = 64;
    lab[act]();
    const pen = small.getContext("2d");
    pen.drawImage(lab.view.canvas, 0, 0, 64, 64);
    const data = pen.getImageData(0, 0, 64, 64).data, seen = new Set();
    for (let i = 0; i < data.length; i += 4)
        seen.add((data[i] >> 4) * 256 + (data[i + 1] >> 4) * 16 + (data[i + 2] >> 4));
    return seen.size;
}, how);

async function checkAxe(page, name) {
    await page.evaluate(AXE);
    const { violations } = await page.evaluate(() => window.axe.run(document, { resultTypes: ["violations"] }));
    assert.deepEqual(violations.map((v) => `${name}: ${v.id}: ${v.nodes.map((node) => node.html.slice(0, 100)).join(" ")}`), []);
}

const noSidewaysScroll = async (page) => assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= window.innerWidth), "no sideways scrolling");

/* No word is cut off, and no two of the page's controls lie over each other. */
async function nothingOverlaps(page, where) {
    await noSidewaysScroll(page);
    const bad = await page.evaluate(() => {
        const shown = [...document.querySelectorAll("button, label, select, dt, dd, summary, legend, h1, h2, input, output")].filter((element) => element.checkVisibility());
        const name = (element) => `${element.id || element.tagName} "${element.textContent.slice(0, 40)}"`;
        const cut = shown.filter((element) => element.tagName !== "INPUT" && element.scrollWidth > element.clientWidth + 1 && element.clientWidth > 0).map((element) => `cut: ${name(element)}`);
        const inView = document.getElementById("view-box").getBoundingClientRect();
        cut.push(...[...document.querySelectorAll("#legend span, #live")].filter((element) => element.getBoundingClientRect().left < inView.left + 8).map((element) => `cut: ${element.textContent}`));
        const boxes = shown.map((element) => [element, element.getBoundingClientRect()]);
        const over = boxes.flatMap(([a, p], i) => boxes.slice(i + 1).filter(([b, q]) => !a.contains(b) && !b.contains(a)
            && Math.min(p.right, q.right) - Math.max(p.left, q.left) > 1 && Math.min(p.bottom, q.bottom) - Math.max(p.top, q.top) > 1).map(([b]) => `over: ${name(a)} and ${name(b)}`));
        const pen = document.createElement("canvas").getContext("2d");
        const chosen = [...document.querySelectorAll("select")].filter((select) => select.checkVisibility()).flatMap((select) => {
            const style = getComputedStyle(select);
            pen.font = `${style.fontSize} ${style.fontFamily}`;
            return [...select.options].filter((option) => pen.measureText(option.text).width > select.clientWidth - 38).map((option) => `cut in its list: ${option.text}`);
        });
        const { lab } = window.festoonLab, { canvas, plot } = lab.panels, inPlot = [], usual = canvas.pen.fillText;
        canvas.pen.fillText = (text, x, y, room = Infinity) => {
            const wide = Math.min(room, canvas.pen.measureText(text).width), left = x - { left: 0, center: wide / 2, right: wide }[canvas.pen.textAlign];
            if (left < 0 || left + wide > canvas.width + 0.5)
                inPlot.push(`cut in the plot: ${text}`);
        };
        if (canvas.width)
            for (const name of ["phi", "sweep", "path", plot])
                lab.panels.choosePlot(name);
        canvas.pen.fillText = usual;
        lab.panels.choosePlot(plot);
        return [...cut, ...over, ...chosen, ...inPlot];
    });
    assert.deepEqual(bad, [], where);
}

/* The page as it is printed: what it says, and on how many sheets.  To the page it is a print like any other. */
async function paper(page, name) {
    await page.emulateMediaType("print");
    const text = await page.evaluate(() => document.body.innerText);
    if (PICTURES)
        await page.screenshot({ path: join(PICTURES, `${name}.png`), fullPage: true });
    await page.emulateMediaType(null);
    const sheets = await page.pdf({ format: "A4", margin: { top: "12mm", bottom: "12mm", left: "14mm", right: "14mm" } });
    return { pages: (Buffer.from(sheets).toString("latin1").match(/\/Type\s*\/Page\b/g) ?? []).length, text };
}

const tests = {
    async "golden hash, runs and a sweep in workers have the program's bits"() {
        const page = await open();
        const source = readFileSync(join(SOURCE_DIR, "tests", "ode", "test_golden.c"), "utf8");
        const [trajectories, jacobians] = /TRAJECTORIES = UINT64_C\(0x(\w+)\), JACOBIANS = UINT64_C\(0x(\w+)\)/.exec(source).slice(1);
        const hashes = await page.evaluate(`(${goldenHashes.toString()})(window.festoonLab.core)`);
        assert.deepEqual(hashes, { trajectories, jacobians });
        for (const scene of [{ "drive.frequency": "10.7 Hz", "run.periods": 100 }, { "friction.law": "coulomb", "run.periods": 60 }]) {
            const result = await page.evaluate((s) => window.festoonLab.run(s).then((r) => JSON.stringify(r)), scene);
            const expected = JSON.parse(festoon("run", "--json", ...Object.entries(scene).flatMap(([k, v]) => ["--set", `${k}=${v}`])));
            assert.equal(result, JSON.stringify(expected));
        }
        const file = join(scratch, "sweep.db");
        festoon("sweep", "--portable", "--set", "run.periods=60", "--over", "drive.frequency=8:20:9", "-o", file);
        const parsed = JSON.parse(festoon("export", file, "--json")), rows = parsed.points || parsed.rows || parsed;
        const swept = await page.evaluate(() => window.festoonLab.sweep({ "run.periods": 60 }, "drive.frequency=8:20:9"));
        const names = await page.evaluate(() => window.festoonLab.core.results.map((row) => row.name));
        assert.equal(swept.length, rows.length);
        rows.forEach((row, i) => names.forEach((name) => assert.equal(swept[i][name], row[name], `${name} at point ${i}`)));
        await close(page);
    },
    async "a run can be stopped, and a bad scene is refused in the library's words"() {
        const page = await open();
        const stopped = await page.evaluate(() => {
            const running = window.festoonLab.run({ "run.periods": 1e7 }).then(() => "done", (error) => error.message);
            window.festoonLab.stop();
            return running;
        });
        assert.equal(stopped, "stopped");
        assert.match(await page.evaluate(() => window.festoonLab.run({ "drive.frequency": "fast" }).then(() => "", (error) => error.message)), /number/);
        await close(page);
    },
    async "click through: experiments, cameras, plots, at both sizes"() {
        for (const [name, size] of Object.entries(SIZES)) {
            const page = await open("", { size });
            await described(page);
            const presets = await page.$$eval("#presets button", (buttons) => buttons.map((button) => button.dataset.preset));
            assert.equal(presets.length, 13);
            for (const preset of presets) {
                await click(page, `[data-preset=${preset}]`);
                await described(page);
                assert.ok(await coloursOfView(page) > 12, `${preset}: the view is not blank`);
                await picture(page, `${name}-preset-${preset}`);
            }
            await click(page, "[data-preset=walker]");
            const pair = await page.evaluate(() => {
                const { lab } = window.festoonLab;
                lab.play(false);
                return [lab.rows.length, lab.trails.length, lab.settings.slow];
            });
            assert.deepEqual(pair, [2, 2, 30]);
            await page.waitForFunction(() => window.festoonLab.lab.recording.done, { timeout: 0 });
            const gone = await page.evaluate(() => {
                const { lab } = window.festoonLab, before = lab.row[0];
                const done = lab.advance(0.1);
                lab.play(true);
                return [Math.abs(lab.row[0] - before - 0.1) < 1e-9 && done > 0.09, lab.trails.every((trail) => trail.count > 100), document.getElementById("legend").textContent];
            });
            assert.deepEqual(gone, [true, true, "bead 1bead 2"]);
            await page.evaluate(() => window.festoonLab.lab.advance(100));
            assert.match(await page.$eval("#notice", (notice) => notice.textContent), /run ends here/);
            await click(page, "#play");
            assert.ok(await page.evaluate(() => window.festoonLab.lab.row[0] < 1 && window.festoonLab.lab.playing), "it begins again");
            await click(page, "[data-preset=four]");
            assert.equal(await page.evaluate(() => window.festoonLab.lab.rows.length), 1);
            for (const camera of ["above", "free", "magnet", "bead"]) {
                await click(page, `[data-camera=${camera}]`);
                assert.equal(await page.$eval(`[data-camera=${camera}]`, (button) => button.getAttribute("aria-pressed")), "true");
                assert.ok(await coloursOfView(page) > 12);
                await picture(page, `${name}-camera-${camera}`);
            }
            await click(page, "#tab-path");
            await picture(page, `${name}-plot-path`);
            await click(page, "#tab-sweep");
            await page.$eval("#sweep-points", (field) => (field.value = "9"));
            await click(page, "#sweep-go");
            await page.waitForFunction(() => /^9 of 9/.test(document.getElementById("sweep-done").textContent), { timeout: 0 });
            await picture(page, `${name}-plot-sweep`);
            for (const summary of await page.$$("#all-controls summary"))
                await summary.evaluate((element) => element.click());
            await noSidewaysScroll(page);
            const seen = await page.evaluate(async () => {
                window.festoonLab.lab.tell("x is bad", true);
                await new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve)));
                document.getElementById("files").scrollIntoView();
                const box = (id) => document.getElementById(id).getBoundingClientRect(), [view, files, notice] = ["view-box", "files", "notice"].map(box);
                return { view: view.top >= notice.bottom && view.bottom <= files.top, notice: notice.top >= 0 && notice.bottom > 0, boxes: [notice.bottom, view.top, view.bottom, files.top].join() };
            });
            assert.deepEqual([seen.view, seen.notice], [name === "narrow", true], `${seen.boxes}: on a phone the picture stays above the controls, and news are seen everywhere`);
            await close(page);
        }
    },
    async "the lesson: six steps, each predicted, observed and explained, and accessible"() {
        for (const [name, size] of Object.entries(SIZES)) {
            const page = await open("", { size });
            await click(page, "#lesson-open");
            for (let step = 1; step <= 6; ++step) {
                assert.match(await page.$eval("#lesson h2", (heading) => heading.textContent), new RegExp(`^Step ${step}:`));
                assert.equal(await page.evaluate(() => window.festoonLab.lab.playing), false, "nothing moves before the answer");
                assert.equal(await page.$("#lesson .explain"), null);
                assert.equal(await page.$eval("#regime", (text) => getComputedStyle(text).visibility), "hidden", "nothing tells the answer");
                const places = await page.evaluate(() => ["view-box", "lesson"].map((id) => document.getElementById(id).getBoundingClientRect()).map(({ top, bottom }) => [top, bottom]));
                assert.ok(places[0][0] >= 0 && places[0][1] <= size.height && places[1][0] < size.height / 2, `${name} ${step}: picture and question are on the screen: ${places}`);
                assert.equal(await page.evaluate(() => window.festoonLab.lab.panels.plot), "phi");
                await picture(page, `${name}-lesson-${step}-question`);
                await click(page, "#lesson .answers button:last-child");
                assert.equal(await page.evaluate(() => window.festoonLab.lab.playing), true);
                if (step === 5)
                    assert.ok(await page.$eval("#plot", (plot) => plot.getBoundingClientRect().top > document.getElementById("view-box").getBoundingClientRect().bottom && plot.getBoundingClientRect().bottom <= window.innerHeight), "the curve is on the screen");
                await click(page, "#lesson .strong");
                assert.ok((await page.$eval("#lesson .explain", (text) => text.textContent)).length > 100);
                await described(page);
                await picture(page, `${name}-lesson-${step}`);
                await checkAxe(page, `lesson ${step}`);
                await noSidewaysScroll(page);
                if (step === 5)
                    await page.waitForFunction(() => /^33 of 33/.test(document.getElementById("sweep-done").textContent), { timeout: 0 });
                if (step < 6)
                    await click(page, "#lesson nav button:last-child");
            }
            await close(page);
        }
    },
    async "each language fills the page, from the address, the browser or the selector; its numbers come and go with a comma"() {
        const words = { en: /^Counter-rotating: .* 3\.\d\d? turns/, de: /^Gegenläufig: .* 3,\d\d? Umdrehungen/, fr: /^Contrarotative.: .* 3,\d\d? tours/, es: /^Contrarrotante: .* 3,\d\d? vueltas/, zh: /^反向绕行：.* 3\.\d\d? 圈/ };
        for (const [language, regime] of Object.entries(words))
            for (const [name, size] of Object.entries({ ...SIZES, wide: { width: 1280, height: 800 } })) {
                const page = await open(`#v=1&drive.frequency=10.7+Hz&ui.settle=20&ui.lang=${language}`, { size });
                await page.waitForFunction(() => document.querySelector("#numbers dd"), { timeout: 0 });
                assert.match(await page.$eval("#regime", (text) => text.textContent), regime);
                assert.equal((await page.evaluate(() => document.documentElement.lang)).slice(0, 2), language);
                assert.equal(await page.$eval("#language", (select) => select.value), language);
                await picture(page, `${name}-${language}`);
                const comma = ["en", "zh"].includes(language) ? "." : ",";
                await type(page, "#p-drive-frequency", `12${comma}5 Hz`);
                assert.equal(await page.$eval("#p-drive-frequency", (field) => field.value), `12${comma}5 Hz`);
                await type(page, "#p-magnet-depth", "17.25 mm");
                assert.equal(await page.$eval("#p-magnet-depth", (field) => field.value), `17${comma}25 mm`);
                assert.deepEqual(await page.evaluate(() => ["drive.frequency", "magnet.depth"].map((key) => window.festoonLab.core.value(key))), [12.5, 0.01725]);
                assert.match(await page.evaluate(() => location.hash), /drive\.frequency=12\.5\+Hz&magnet\.depth=17\.25\+mm.*ui\.lang=/);
                await nothingOverlaps(page, `${language} ${name}`);
                for (const quantity of name === "narrow" ? await page.$$eval("#colour option", (options) => options.map(({ value }) => value)) : []) {
                    await page.select("#colour", quantity);
                    await page.evaluate(() => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))));
                    await nothingOverlaps(page, `${language} ${name} ${quantity}`);
                }
                await page.$$eval("#all-controls summary", (all) => all.forEach((summary) => summary.click()));
                await page.$$eval("button.more", (all) => all[0].click());
                await nothingOverlaps(page, `${language} ${name}, all`);
                await checkAxe(page, `${language} ${name}`);
                await click(page, "#lesson-open");
                for (let step = 1; step <= 6; ++step) {
                    await click(page, "#lesson .answers button:last-child");
                    await click(page, "#lesson .strong");
                    await nothingOverlaps(page, `${language} ${name}, step ${step}`);
                    await picture(page, `${name}-${language}-lesson-${step}`);
                    if (step < 6)
                        await click(page, "#lesson nav button:last-child");
                }
                await close(page);
            }
    },
    async "the selector changes the words and nothing else: motion, answer, curve and controls stay"() {
        const page = await open("", { languages: ["pt-BR", "fr-CA", "en"] });
        assert.deepEqual(await page.evaluate(() => [document.documentElement.lang, document.getElementById("language").value, location.hash.includes("ui.lang")]), ["fr", "fr", false]);
        await click(page, "#lesson-open");
        await click(page, "#lesson .answers button:nth-child(2)");
        await click(page, "#lesson .strong");
        await click(page, "#tab-sweep");
        await type(page, "#sweep-to", "12,5");
        await page.$$eval("#all-controls summary", (all) => all[1].click());
        const state = () => page.evaluate(() => {
            const { lab } = window.festoonLab;
            lab.play(false);
            return [JSON.stringify(lab.scene), lab.row[1], lab.trail.count, lab.panels.plot, document.getElementById("sweep-to").value, lab.camera.mode, lab.settings.slow,
                [...document.querySelectorAll("#lesson .answers button")].map((button) => button.getAttribute("aria-pressed")).join(), [...document.querySelectorAll("#all-controls details")].findIndex((group) => group.open),
                document.querySelectorAll("#cameras button").length, document.querySelectorAll("#plot-tabs button").length, document.querySelectorAll("#files button").length, document.querySelectorAll("[id]").length - new Set([...document.querySelectorAll("[id]")].map(({ id }) => id)).size];
        });
        const before = await state();
        await page.select("#language", "de");
        assert.deepEqual(await state(), before);
        assert.deepEqual(await page.evaluate(() => [document.documentElement.lang, document.title, document.querySelector("#lesson .bad").textContent, document.querySelector("#lesson .explain") !== null, document.getElementById("lesson-open").textContent]),
            ["de", "festoon lab: eine magnetische Kugel auf einem Magnetrührer", "Sieh genau hin: Sie tut etwas anderes.", true, "Lektion schließen"]);
        assert.match(await page.evaluate(() => location.hash), /ui\.lang=de/);
        await click(page, "#sweep-go");
        await page.waitForFunction(() => /^57 von 57 Punkten/.test(document.getElementById("sweep-done").textContent), { timeout: 0 });
        assert.equal(await page.evaluate(() => Math.max(...[...window.festoonLab.lab.panels.points.values()].map((point) => point.frequency_hz))), 12.5);
        await click(page, "#play");
        assert.equal(await page.$eval("#play", (button) => button.textContent), "Anhalten");
        await page.select("#language", "zh");
        assert.equal(await page.$eval("#play", (button) => button.textContent), "暂停");
        await close(page);
    },
    async "the worksheet: the lesson on paper in the language of the page, with lines and a table, and no answer"() {
        for (const language of Object.keys(TABLES)) {
            const page = await open(`#v=1&ui.step=2&ui.lang=${language}`);
            await page.evaluate(() => (window.print = () => (window.printed = true)));
            await click(page, "#worksheet-open");
            assert.ok(await page.evaluate(() => window.printed));
            const { pages, text } = await paper(page, `worksheet-${language}`);
            const steps = await page.$$eval("#worksheet section", (sections) => sections.length), empty = await page.$$eval("#worksheet td", (cells) => cells.filter((cell) => !cell.textContent).length);
            assert.deepEqual([steps, empty, pages], [7, 21, 3], language);
            assert.ok(text.includes(["de", "fr", "es"].includes(language) ? "10,7\t" : "10.7\t"), "a row of the table");
            for (const { question, answers, observe, explain } of TABLES[language].lesson)
                assert.deepEqual([question, ...answers, observe, explain].map((part) => text.includes(part)), [true, true, true, true, false, false], question);
            assert.deepEqual(await page.evaluate(() => ["worksheet", "stage"].map((id) => document.getElementById(id).checkVisibility())), [false, true], "the screen as before");
            await close(page);
        }
    },
    async "the ramp of the second step ends in counter-rotation"() {
        const page = await open("#v=1&drive.frequency=8.3+Hz&ui.ramp=9.6&ui.settle=100&ui.slow=1");
        const before = await page.evaluate(() => {
            const { lab } = window.festoonLab;
            lab.play(false);
            const { COLUMN } = { COLUMN: { alpha: 7 } }, start = lab.row[COLUMN.alpha];
            lab.advance(1);
            return lab.row[COLUMN.alpha] - start;
        });
        await described(page);
        assert.match(await page.$eval("#regime", (text) => text.textContent), /^The speed of the magnet changes/);
        assert.deepEqual(await page.evaluate(() => [document.getElementById("numbers").textContent, document.getElementById("why").hidden]), ["", true], "nothing is said of the speed that it has left");
        assert.ok(before > 30, "at first it goes with the magnet");
        const after = await page.evaluate(() => {
            const { lab } = window.festoonLab;
            for (let i = 0; i < 8; ++i)
                lab.advance(1);
            const start = lab.row[7];
            lab.advance(1);
            return { turned: lab.row[7] - start, frequency: lab.frequency(), ramping: Boolean(lab.ramping) };
        });
        assert.ok(after.turned < -15, "in the end it goes against it");
        assert.ok(Math.abs(after.frequency - 9.6) < 1e-6 && !after.ramping);
        await page.waitForFunction(() => /^Counter-rotating/.test(document.getElementById("regime").textContent), { timeout: 0 });
        await close(page);
    },
    async "axe has no complaint, in light and dark"() {
        for (const scheme of ["light", "dark"])
            for (const [name, size] of Object.entries(SIZES)) {
                const page = await open("", { size });
                await page.emulateMediaFeatures([{ name: "prefers-color-scheme", value: scheme }]);
                await described(page);
                await page.$$eval("#all-controls summary", (all) => all.forEach((summary) => summary.click()));
                await page.$$eval(".more", (all) => all.slice(0, 4).forEach((button) => button.click()));
                await checkAxe(page, `${name} ${scheme}`);
                await picture(page, `${name}-${scheme}`);
                await close(page);
            }
    },
    async "a change of a control reaches library, address and numbers; nonsense stays outside with a sentence"() {
        const page = await open();
        await type(page, "#p-drive-frequency", "900 rpm");
        assert.equal(await page.evaluate(() => window.festoonLab.core.value("drive.frequency")), 15);
        assert.match(await page.evaluate(() => location.hash), /drive\.frequency=900\+rpm/);
        await page.waitForFunction(() => /12\.\d festoons/.test(document.getElementById("regime").textContent), { timeout: 0 });
        await type(page, "#p-drive-frequency", "-3 <b>Hz</b>");
        assert.match(await page.$eval("#p-drive-frequency-error", (text) => text.textContent), /drive\.frequency: .*/);
        assert.equal(await page.$("#p-drive-frequency-error b"), null);
        assert.equal(await page.evaluate(() => window.festoonLab.core.value("drive.frequency")), 15);
        await page.select("#p-friction-law", "coulomb");
        assert.match(await page.evaluate(() => location.hash), /friction\.law=coulomb/);
        await page.$eval("#slow", (slider) => {
            slider.value = slider.max;
            slider.dispatchEvent(new Event("input", { bubbles: true }));
        });
        assert.match(await page.evaluate(() => location.hash), /ui\.slow=200/);
        await close(page);
    },
    async "what is refused, and why a run is what it is, is told in the page's language; what has no words in it says that it is English"() {
        const page = await open("#v=1&drive.frequency=10.7+Hz&run.periods=60&run.discard=30");
        for (const [language, refused, why] of [["en", /is out of range/, /^A closed orbit.*\.$/], ["de", /liegt außerhalb des Bereichs von/, /^Eine geschlossene Bahn.*\.$/], ["fr", /sort du domaine permis/, /^Une orbite fermée.*\.$/], ["es", /está fuera del intervalo/, /^Una órbita cerrada.*\.$/], ["zh", /超出范围/, /^闭合轨道.*。$/]]) {
            await page.select("#language", language);
            const told = await page.$$eval("#controls .row > .error", (all) => all.map((error) => {
                const field = error.parentElement.querySelector("input[type=text]");
                const tried = ["-1e99", "1e99", "x"].map((value) => {
                    if (field)
                        field.value = value;
                    field?.dispatchEvent(new Event("change", { bubbles: true }));
                    return error.textContent;
                });
                return field ? { id: field.id, tried, english: error.querySelectorAll("[lang]").length } : null;
            }).filter(Boolean));
            assert.ok(told.length > 25);
            told.forEach(({ id, tried, english }) => assert.ok(tried.every((text) => text.length > 10) && english === 0, `${language} ${id}: ${tried}`));
            assert.ok(told.filter(({ tried }) => refused.test(tried[1])).length > 20);
            await page.waitForFunction((pattern) => new RegExp(pattern, "s").test(document.getElementById("why-text").textContent), { timeout: 0 }, why.source);
            const english = await page.evaluate(() => {
                window.festoonLab.lab.files.open({ name: "a.yaml", size: 1, type: "", text: () => Promise.reject(new Error("the <b>disk</b> is gone")) });
                return new Promise((resolve) => setTimeout(() => resolve([document.getElementById("notice").textContent, document.querySelector("#notice [lang=en]")?.textContent ?? null])));
            });
            assert.match(english[0], /^a\.yaml\s?[:：]\s?the <b>disk<\/b> is gone$/);
            assert.equal(english[1], language === "en" ? null : "the <b>disk</b> is gone");
            await nothingOverlaps(page, `${language}, with errors`);
            await picture(page, `wide-errors-${language}`);
        }
        await checkAxe(page, "errors");
        await close(page);
        const bad = await open("#v=1&drive.frequency=12+parsec&start.r=50&ui.lang=de&foo=1");
        assert.match(await bad.$eval("#notice", (notice) => notice.textContent), /^drive\.frequency: „12 parsec“ hat die unbekannte Einheit .*\. start\.r = 50 liegt jenseits des Plattenrands.*foo/);
        await close(bad);
    },
    async "an address brings the same state back; unknown keys are named as text"() {
        const first = await open("#v=1&drive.frequency=14.5+Hz&magnet.depth=15+mm&friction.law=coulomb&ui.camera=magnet&ui.slow=100&ui.arrows=moment,load&ui.colour=slip");
        const hash = await first.evaluate(() => location.hash), scene = await first.evaluate(() => window.festoonLab.core.scene());
        const second = await open(hash);
        assert.deepEqual(await second.evaluate(() => window.festoonLab.core.scene()), scene);
        assert.equal(await second.evaluate(() => location.hash), hash);
        assert.deepEqual(await second.evaluate(() => [window.festoonLab.lab.camera.mode, window.festoonLab.lab.settings.slow, window.festoonLab.lab.settings.colour]), ["magnet", 100, "slip"]);
        await close(first);
        await close(second);
        const hostile = await open("#v=1&%3Cimg%20src%3Dx%20onerror%3Dalert(1)%3E=1&drive.frequency=%3Cscript%3E&drive.frequncy=3");
        const notice = await hostile.$eval("#notice", (text) => [text.textContent, text.children.length]);
        assert.match(notice[0], /drive\.frequncy/);
        assert.equal(notice[1], 0);
        await close(hostile);
        for (const words of ["ui.colour=constructor&ui.arrows=toString", "drive.frequency=1e-6&ui.settle=1000", "drive.frequency=1e6&ui.settle=1000&ui.slow=1"]) {
            const page = await open(`#v=1&${words}`); /* and two pictures more: the page lives */
            await page.evaluate(() => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))));
            assert.equal(await page.evaluate(() => window.festoonLab.lab.settings.arrows.size), 0);
            await close(page);
        }
    },
    async "a disc of contact is chosen in one step, with a size, and a list shows what the scene has"() {
        const page = await open("#v=1&friction.law=coulomb"), shown = () => page.evaluate(() => [["contact-patch", "value"], ["contact-radius", "value"], ["contact-patch-error", "textContent"], ["magnet-shape", "value"]].map(([id, what]) => document.getElementById(`p-${id}`)[what]));
        await page.select("#p-contact-patch", "hertz");
        assert.deepEqual(await shown(), ["hertz", "0.1 mm", "", "lines"]);
        assert.match(await page.evaluate(() => location.hash), /contact\.patch=hertz&contact\.radius=0\.1\+mm/);
        await page.select("#p-contact-patch", "point");
        assert.deepEqual(await shown(), ["point", "", "", "lines"]);
        await page.select("#p-magnet-shape", "parts");
        assert.deepEqual(await shown(), ["point", "", "", "lines"], "refused: there are none");
        assert.match(await page.$eval("#p-magnet-shape-error", (error) => error.textContent), /list them in magnet\.parts/);
        await type(page, "#p-friction-mu_static", "0.3");
        assert.deepEqual(await page.$eval("#p-friction-mu", (field) => {
            const slider = field.closest(".row").querySelector("[type=range]");
            slider.value = "0.5";
            slider.dispatchEvent(new Event("input"));
            return [field.value, slider.value, field.getAttribute("aria-invalid")];
        }), ["0.2", "0.2", "true"]);
        await close(page);
    },
    async "dropped files: a scene, a track, and hostile ones as text alone"() {
        const page = await open();
        const drop = (name, text) => page.evaluate(async (n, t) => {
            await window.festoonLab.lab.files.open(new File([t], n));
            return [document.getElementById("notice").textContent, document.getElementById("notice").children.length];
        }, name, text);
        const state = () => page.evaluate(() => {
            const { lab } = window.festoonLab;
            lab.play(false);
            return [JSON.stringify(lab.scene), window.festoonLab.core.scene(), lab.row[0], lab.trail.count, location.hash, lab.track.length, lab.lesson.at];
        });
        await click(page, "[data-preset=critical]");
        await drop("bead.yaml", festoon("init", "-", "--set", "drive.frequency=16Hz"));
        assert.deepEqual(await page.evaluate(() => [window.festoonLab.lab.settings.ramp, window.festoonLab.lab.settings.settle]), [null, 0], "nothing of the experiment before");
        assert.equal(await page.evaluate(() => window.festoonLab.core.value("drive.frequency")), 16);
        const track = `frame,t [s],x [mm],y [mm]\n${Array.from({ length: 90 }, (_, i) => `${i},${i / 30},${18 * Math.cos(i / 9)},${18 * Math.sin(i / 9)}`).join("\n")}\n`;
        assert.match((await drop("track.csv", track))[0], /90 places/);
        await picture(page, "wide-track");
        const pair = `frame,t [s],x [mm],y [mm],track,doubts\n${Array.from({ length: 90 }, (_, i) => [1, -1].map((side, k) => `${i},${i / 30},${side * 18 * Math.cos(i / 30)},${side * 18 * Math.sin(i / 30)},${k + 1},0`).join("\n")).join("\n")}\n`;
        assert.match((await drop("pair.csv", pair))[0], /^180 places of the track of 2 beads/);
        await picture(page, "wide-track-of-two");
        assert.deepEqual(await page.evaluate(() => {
            const { track, view } = window.festoonLab.lab, longest = track.map((line) => Math.max(...line.slice(1).map((p, i) => Math.hypot(p[0] - line[i][0], p[1] - line[i][1]))));
            return [track.length, longest.every((step) => step < 0.1), new Set(view.tracks.map(({ colours }) => colours.slice(0, 3).join())).size];
        }), [2, true, 2], "no line from bead to bead, and two colours");
        await drop("track.csv", track);
        assert.deepEqual(await page.evaluate(() => window.festoonLab.lab.view.tracks.map(({ mesh }) => mesh.visible)), [true, false]);
        const before = await state();
        assert.match((await drop("bead.webm", "x"))[0], /^bead\.webm: this is a film; festoon track/);
        assert.match((await drop("bead.png", "\x89PNG\r\n\0\0\0"))[0], /^bead\.png: this is not text: scenes, tables/);
        const bad = "<img src=x onerror=\"document.title='hit'\">";
        for (const [name, text] of [[`${bad}.yaml`, `drive:\n  ${bad}: 3\n`], ["x.yaml", `drive:\n  frequency: ${bad}\n`], [`${bad}.csv`, `x [${bad}],y\n1,2\n`]]) {
            const [notice, children] = await drop(name, text);
            assert.ok(notice.length > 10 && children === 0);
        }
        assert.notEqual(await page.title(), "hit");
        assert.deepEqual(await state(), before, "what is refused changes nothing, and the track stays");
        await drop("bead.yaml", festoon("init", "-", "--set", "drive.frequency=17Hz"));
        assert.deepEqual(await page.evaluate(() => [window.festoonLab.lab.track, window.festoonLab.core.value("drive.frequency")]), [null, 17], "a track belongs to its scene");
        await close(page);
    },
    async "a dropped map is the magnet: in the view, the address, workers and the other frame; a bad one changes nothing; a scene comes with its map"() {
        const folder = join(SOURCE_DIR, "examples", "magnets"), map = readFileSync(join(folder, "measured-map.csv"), "utf8"), yaml = readFileSync(join(folder, "measured-map.yaml"), "utf8").replace("240", "40").replace("160", "20");
        const drop = (page, ...files) => page.evaluate(async (list) => {
            const data = new DataTransfer();
            list.forEach(([name, text]) => data.items.add(new File([text], name)));
            await window.festoonLab.lab.files.openAll(data.files);
            return document.getElementById("notice").textContent;
        }, files);
        for (const flat of [false, true]) {
            const page = await open("#v=1&drive.frequency=14+Hz&magnet.lines=7&run.periods=40&run.discard=20&ui.camera=above", { flat });
            await page.evaluate(() => window.festoonLab.lab.play(false));
            const state = () => page.evaluate(() => [window.festoonLab.core.get("magnet.shape"), window.festoonLab.lab.scene["magnet.file"] ?? null, location.hash, window.festoonLab.lab.row[0]]);
            const red = () => page.evaluate(() => {
                const { lab } = window.festoonLab, pen = document.createElement("canvas").getContext("2d");
                lab.draw();
                pen.drawImage(lab.view.canvas, 0, 0, 300, 150);
                const { data } = pen.getImageData(0, 0, 300, 150);
                return [0, 2].map((c) => data.filter((v, i) => i % 4 === c && v > data[i + 2 - 2 * c] + 25).length);
            });
            const before = await state();
            assert.match(await drop(page, ["hole.csv", map.replace(/^.*\n/gm, (line, at) => (at > 9000 && at < 9040 ? "" : line))]), /^hole\.csv: the map has a hole/);
            assert.match(await drop(page, ["map.h5", "x"]), /^map\.h5: this page reads tables .*: festoon run --csv makes one of a motion, festoon field --csv one of a field$/);
            assert.match(await drop(page, ["high.csv", map.replaceAll(",18.7,", ",20,")]), /^high\.csv: magnet\.file: the bead's centre moves 18\.7 mm .* taken at 20 mm/);
            assert.deepEqual(await state(), before, "nothing has changed");
            assert.match(await drop(page, ["measured-map.csv", map]), /^measured-map\.csv is the magnet now\. The map of magnet\.file has a curl of 0\.\d+: smoothing fits a field without curl\.$/);
            const [shape, name, hash] = await state();
            assert.deepEqual([shape, name], ["grid", "measured-map.csv"]);
            assert.match(hash, /magnet\.shape=grid&magnet\.file=measured-map\.csv&magnet\.checksum=[0-9a-f]{16}/);
            assert.ok((await red()).every((count) => count > 1000), "its poles are red and blue");
            await page.waitForFunction(() => window.festoonLab.lab.panels.result?.scene["magnet.shape"] === "grid", { timeout: 0 });
            assert.match(await page.$eval("#camera-help", (text) => text.textContent), /measured field points up/);
            await picture(page, `wide-map-${flat ? "flat" : "above"}`);
            if (!flat) {
                await click(page, "[data-camera=free]");
                await picture(page, "wide-map-free");
                const swept = await page.evaluate(() => window.festoonLab.sweep({ ...window.festoonLab.lab.scene, "run.periods": 10, "run.discard": 5 }, "drive.frequency=10:14:2"));
                assert.ok(swept.every((row) => row.mean_r > 0.1));
                await page.select("#p-magnet-shape", "lines");
                assert.deepEqual((await state()).slice(0, 2), ["lines", null]);
                await page.select("#p-magnet-shape", "grid");
                assert.deepEqual((await state()).slice(0, 2), ["grid", "measured-map.csv"]);
                await click(page, "#beside-open");
                await page.waitForFunction(() => window.frames.length === 2 && [0, 1].every((i) => window.frames[i].festoonLab?.lab?.playing), { timeout: 0 });
                assert.deepEqual(await page.evaluate(() => [0, 1].map((i) => window.frames[i].festoonLab.core.get("magnet.shape"))), ["grid", "grid"]);
                await click(page, "#beside-close");
                await page.waitForFunction(() => window.frames.length === 0, { timeout: 0 });
            }
            await close(page);
        }
        const page = await open();
        const taken = (of) => of.evaluate(() => [window.festoonLab.core.value("drive.frequency"), window.festoonLab.core.get("magnet.shape"), window.festoonLab.core.get("friction.law")]);
        assert.match(await drop(page, ["mine.yaml", yaml]), /^mine\.yaml: magnet\.file: the page does not have the map measured-map\.csv yet/);
        assert.match(await drop(page, ["measured-map.csv", map]), /^measured-map\.csv is the magnet now/);
        assert.deepEqual(await taken(page), [14, "grid", "coulomb"], "of the scene that waited for it");
        await click(page, "[data-preset=four]");
        assert.match(await drop(page, ["mine.yaml", yaml], ["measured-map.csv", map]), /^mine\.yaml is open\. The map of magnet\.file has a curl/);
        assert.deepEqual(await taken(page), [14, "grid", "coulomb"]);
        const hash = await page.evaluate(() => location.hash);
        await close(page);
        const later = await open(hash);
        assert.match(await later.$eval("#notice", (notice) => notice.textContent), /^magnet\.file: the page does not have the map measured-map\.csv yet: drop its file here\. .*All else/);
        assert.deepEqual(await taken(later), [14, "lines", "coulomb"]);
        await drop(later, ["measured-map.csv", map]);
        assert.deepEqual(await taken(later), [14, "grid", "coulomb"]);
        assert.match(await later.evaluate(() => location.hash), /magnet\.file=measured-map\.csv&magnet\.checksum=[0-9a-f]{16}/);
        await close(later);
    },
    async "a dropped trajectory is played as it was recorded, in its own scene; a change computes anew"() {
        const page = await open(), drop = (name, text) => page.evaluate((n, t) => window.festoonLab.lab.files.open(new File([t], n)), name, text);
        const csv = (...sets) => {
            const file = join(scratch, "played.csv");
            festoon("run", ...sets.flatMap((set) => ["--set", set]), "--units", "lab", "--csv", file);
            return readFileSync(file, "utf8");
        };
        const state = () => page.evaluate(() => {
            const { lab } = window.festoonLab;
            return { rows: lab.rows.length, time: lab.row[0], x: lab.row[3], radius: lab.units.mm, samples: lab.recording?.samples.length ?? 0, f: window.festoonLab.core.value("drive.frequency") };
        });
        const single = csv("drive.frequency=14.5Hz", "run.periods=6", "run.discard=1"), lines = single.trim().split("\n").filter((line) => !line.startsWith("#")).map((line) => line.split(","));
        await drop("mine.csv", single);
        assert.match(await page.$eval("#notice", (notice) => notice.textContent), /^mine\.csv is played as it was recorded/);
        await page.evaluate(() => window.festoonLab.lab.play(false));
        assert.deepEqual([(await state()).samples, (await state()).f], [lines.length - 1, 14.5]);
        await click(page, "#restart");
        await page.evaluate(() => window.festoonLab.lab.advance(100));
        await page.waitForFunction((end) => Math.abs(document.querySelector("#time").max - end) < 1e-9, {}, Number(lines.at(-1)[0]));
        await page.$eval("#time", (slider) => {
            slider.value = slider.max / 2;
            slider.dispatchEvent(new Event("input", { bubbles: true }));
        });
        const middle = await page.evaluate(() => [window.festoonLab.lab.row[0], window.festoonLab.lab.trail.samples[0][0]]), turn = 1 / 14.5;
        assert.ok(Math.abs(middle[0] - Number(lines.at(-1)[0]) / 2) < 1e-12 && middle[1] < turn, `its time is moved, with a trail before: ${middle}`);
        await page.evaluate(() => window.festoonLab.lab.advance(100));
        const place = (name) => lines[0].findIndex((head) => head.split(" ")[0] === name), last = lines.at(-1), end = await state();
        assert.ok(Math.abs(end.time - Number(last[0])) < 1e-12 && Math.abs(end.x * end.radius - Number(last[place("x")])) < 1e-9, JSON.stringify(end));
        assert.ok(await coloursOfView(page) > 12);
        await picture(page, "wide-played");
        await described(page);
        await type(page, "#p-drive-frequency", "15 Hz");
        assert.deepEqual(await page.evaluate(() => [window.festoonLab.lab.recording, window.festoonLab.lab.row[0]]), [null, 0]);
        await page.waitForFunction(() => document.querySelector("#time").hidden, { timeout: 10000 }); /* the next picture hides it */
        festoon("run", "--csv", join(scratch, "usual.csv")); /* as large as a run is that nobody has shortened */
        await (await page.$("#open")).uploadFile(join(scratch, "usual.csv"));
        await page.waitForFunction(() => /^usual\.csv/.test(document.getElementById("notice").textContent), { timeout: 0 });
        assert.match(await page.$eval("#notice", (notice) => notice.textContent), /is played as it was recorded/);
        await drop("two.csv", csv("drive.frequency=30Hz", "beads[0].start.phi=3deg", "beads[1].start.phi=40deg", "run.periods=6", "run.discard=1"));
        assert.equal((await state()).rows, 2);
        const kept = () => page.evaluate(() => {
            const { lab } = window.festoonLab;
            lab.play(false);
            return [JSON.stringify(lab.scene), window.festoonLab.core.scene(), lab.rows.length, lab.row[0], lab.trail.count, lab.replayed !== null, lab.lesson.at, location.hash];
        });
        for (const open of ["[data-preset=critical]", "#lesson-open", null]) {
            if (open)
                await click(page, open);
            else
                await drop("mine.csv", single);
            await page.evaluate(() => window.festoonLab.lab.advance(0.5));
            const before = await kept();
            await drop("<b>bad</b>.csv", single.replace("14.5 Hz", "14.5 furlong"));
            assert.match(await page.$eval("#notice", (notice) => notice.textContent), /^<b>bad<\/b>\.csv: drive\.frequency/);
            await drop("cell.csv", single.replace(/\d+\n$/, "oops\n").replace(/^0,[^,]*/m, "0,oops"));
            assert.match(await page.$eval("#notice", (notice) => notice.textContent), /^cell\.csv: line \d+: drive_turns must be a number/);
            assert.deepEqual(await kept(), before, "a refused file changes nothing");
            assert.ok(await page.evaluate(() => window.festoonLab.lab.advance(0.01)) >= 0, "and the motion goes on");
        }
        await close(page);
    },
    async "parts of a magnet are dragged in the view from above, and with the magnet; elsewhere a pointer turns the view"() {
        for (const flat of [false, true]) {
            const page = await open("", { flat });
            await click(page, "[data-preset=discs]");
            await click(page, "[data-camera=above]");
            await described(page);
            assert.match(await page.$eval("#camera-help", (text) => text.textContent), /Drag a part/);
            /* A pixel looks at places that lie the farther apart, the lower they are. */
            const apart = await page.evaluate(() => {
                const { lab } = window.festoonLab, { view } = lab, { height, width } = view.canvas;
                lab.draw();
                return [0, -0.8].map((z) => Math.hypot(...view.placeAt(0.75, 0.5, z).map((v, i) => v - view.placeAt(0.5, 0.5, z)[i])) / ((view.eye?.position.z ?? 1) - z) / Math.tan((17 * Math.PI) / 180) / (width / height / 2));
            });
            if (!flat)
                apart.forEach((share) => assert.ok(Math.abs(share - 1) < 1e-9, String(apart)));
            /* Move the pointer over the view, from a place of the magnet's frame (mm, height in l) by a path (mm). */
            const drag = (from, by) => page.evaluate(async ([x, y], [dx, dy]) => {
                const { lab } = window.festoonLab, view = document.getElementById("view"), box = view.getBoundingClientRect();
                lab.play(false);
                lab.draw();
                const turns = lab.row[36], c = Math.cos(2 * Math.PI * turns), s = Math.sin(2 * Math.PI * turns), z = lab.bodies[0].centre[2] + lab.bodies[0].size[1] / 2;
                view.setPointerCapture = () => {};
                /* Where a place is seen: by Newton's steps on where a pixel looks. */
                const pixel = (p) => {
                    const want = [c * p[0] - s * p[1], s * p[0] + c * p[1]].map((v) => v / lab.units.mm);
                    let at = [0.5, 0.5];
                    for (let i = 0; i < 20; ++i) {
                        const o = lab.view.placeAt(...at, z), a = lab.view.placeAt(at[0] + 1e-3, at[1], z), b = lab.view.placeAt(at[0], at[1] + 1e-3, z);
                        const m = [a[0] - o[0], b[0] - o[0], a[1] - o[1], b[1] - o[1]].map((v) => 1e3 * v), d = [want[0] - o[0], want[1] - o[1]], det = m[0] * m[3] - m[1] * m[2];
                        at = [at[0] + (m[3] * d[0] - m[1] * d[1]) / det, at[1] + (m[0] * d[1] - m[2] * d[0]) / det];
                    }
                    return { clientX: box.left + at[0] * box.width, clientY: box.top + at[1] * box.height };
                };
                const send = (name, at) => view.dispatchEvent(new PointerEvent(name, { pointerId: 1, bubbles: true, cancelable: true, ...at })), azimuth = lab.camera.place.azimuth;
                send("pointerdown", pixel([x, y]));
                send("pointermove", pixel([x + dx / 2, y + dy / 2]));
                lab.draw(); /* the picture may have come nearer, to hold the magnet */
                const end = pixel([x + dx, y + dy]);
                send("pointermove", end);
                lab.draw();
                send("pointerup", pixel([x + dx, y + dy]));
                return { centres: lab.core.parts().map(({ centre }) => centre.slice(0, 2).map((v) => Math.round(1e5 * v) / 100)), turned: lab.camera.place.azimuth !== azimuth, notice: document.getElementById("notice").textContent, hash: location.hash };
            }, from, by);
            for (const camera of ["above", "magnet"]) {
                await click(page, `[data-preset=discs]`);
                if (camera === "magnet")
                    await click(page, "[data-camera=magnet]");
                else
                    await click(page, "[data-camera=above]");
                const moved = await drag([20, 1], [4, 6]);
                assert.deepEqual([moved.turned, moved.centres[1]], [false, [-18, 0]], camera);
                moved.centres[0].forEach((v, i) => assert.ok(Math.abs(v - [22, 6][i]) < 0.05, `${camera}, flat ${flat}: ${moved.centres[0]}`));
                assert.match(moved.hash, /magnet\.parts%5B0%5D\.centre%5B1%5D=[56]\.\d\d\+mm/);
                await described(page);
                if (!flat)
                    await picture(page, `wide-dragged-${camera}`);
                assert.ok((await drag([0, 25], [3, 3])).turned, "beside the magnets the view turns");
            }
            await click(page, "[data-preset=four]");
            await click(page, "[data-camera=above]");
            assert.ok(!/Drag a part/.test(await page.$eval("#camera-help", (text) => text.textContent)));
            assert.ok((await drag([5, 5], [3, 3])).turned, "the paper's bar has no parts");
            await close(page);
        }
    },
    async "two scenes side by side: each its own, both begun together, and back to the left one"() {
        for (const [name, size] of Object.entries({ wide: { width: 1280, height: 800 }, narrow: SIZES.narrow })) {
            const page = await open("#v=1&drive.frequency=12.5+Hz&ui.camera=above&ui.lang=de", { size });
            await click(page, "#beside-open");
            await page.waitForFunction(() => window.frames.length === 2 && [0, 1].every((i) => window.frames[i].festoonLab?.lab?.playing && window.frames[i].festoonLab.lab.language === "de"), { timeout: 0 });
            const states = () => page.evaluate(() => [0, 1].map((i) => {
                const { lab, core } = window.frames[i].festoonLab;
                return [core.value("drive.frequency"), lab.camera.mode, lab.language, Boolean(window.frames[i].document.getElementById("beside-open"))];
            }));
            assert.deepEqual(await states(), [[12.5, "above", "de", false], [12.5, "above", "de", false]]);
            assert.equal(await page.evaluate(() => window.festoonLab.lab.playing), false, "the page behind them rests");
            const [left, right] = page.frames().filter((frame) => frame !== page.mainFrame());
            await type(right, "#p-friction-law", "coulomb");
            await type(left, "#p-drive-frequency", "13,5 Hz");
            assert.deepEqual(await page.evaluate(() => [0, 1].map((i) => [window.frames[i].festoonLab.core.value("drive.frequency"), window.frames[i].festoonLab.core.get("friction.law")])), [[13.5, "viscous"], [12.5, "coulomb"]]);
            assert.deepEqual(await page.evaluate(() => {
                document.getElementById("beside-restart").click();
                return new Promise((resolve) => setTimeout(() => resolve([0, 1].map((i) => window.frames[i].festoonLab.lab.row[1] < 1))));
            }), [true, true]);
            await page.waitForFunction(() => [0, 1].every((i) => window.frames[i].festoonLab.lab.trail.count > 20), { timeout: 0 });
            await noSidewaysScroll(page);
            assert.equal(await left.$eval("header", (header) => header.checkVisibility()), false);
            await picture(page, `${name}-beside`);
            await click(page, "#beside-close");
            await page.waitForFunction(() => window.festoonLab.lab.playing, { timeout: 0 });
            assert.deepEqual(await page.evaluate(() => [window.frames.length, window.festoonLab.core.value("drive.frequency"), window.festoonLab.core.get("friction.law")]), [0, 13.5, "viscous"]);
            await close(page);
        }
    },
    async "keys: play, step, cameras, lesson, and the view by arrows"() {
        const page = await open();
        await page.evaluate(() => document.activeElement.blur());
        const state = () => page.evaluate(() => ({ playing: window.festoonLab.lab.playing, camera: window.festoonLab.lab.camera.mode, turns: window.festoonLab.lab.row[1], lesson: window.festoonLab.lab.lesson.at, azimuth: window.festoonLab.lab.camera.place.azimuth }));
        const before = await state();
        await page.keyboard.press("Space");
        assert.equal((await state()).playing, !before.playing);
        const paused = await state();
        await page.keyboard.press(".");
        assert.ok((await state()).turns > paused.turns);
        await page.keyboard.press("3");
        assert.equal((await state()).camera, "magnet");
        await page.keyboard.press("2");
        await page.focus("#view");
        const azimuth = (await state()).azimuth;
        await page.keyboard.press("ArrowLeft");
        assert.notEqual((await state()).azimuth, azimuth);
        await page.keyboard.press("r");
        assert.equal((await state()).turns, 0);
        await page.keyboard.press("5");
        assert.equal((await state()).lesson, 0);
        const reached = new Set();
        for (let i = 0; i < 80; ++i) {
            await page.keyboard.press("Tab");
            reached.add(await page.evaluate(() => document.activeElement.id));
        }
        for (const id of ["play", "step", "restart", "slow", "view", "p-drive-frequency"])
            assert.ok(reached.has(id), `${id} is reached by Tab`);
        await close(page);
    },
    async "touch: a finger turns the view, two come closer"() {
        const page = await open("", { size: SIZES.narrow });
        const place = () => page.evaluate(() => ({ ...window.festoonLab.lab.camera.place }));
        const before = await place();
        const point = (type, id, x, y) => page.$eval("#view", (view, t, i, a, b) => view.dispatchEvent(new PointerEvent(t, { pointerId: i, clientX: a, clientY: b, bubbles: true, pointerType: "touch" })), type, id, x, y);
        await page.$eval("#view", (view) => (view.setPointerCapture = () => {}));
        await point("pointerdown", 1, 100, 200);
        await point("pointermove", 1, 160, 210);
        const turned = await place();
        assert.ok(turned.azimuth !== before.azimuth && turned.elevation !== before.elevation);
        await point("pointerdown", 2, 100, 250);
        await point("pointermove", 2, 100, 260);
        await point("pointermove", 2, 40, 330);
        assert.ok((await place()).zoom > before.zoom);
        await close(page);
    },
    async "without WebGL the view is flat and everything else works; reduced motion begins paused"() {
        const page = await open("", { flat: true });
        await described(page);
        assert.match(await page.$eval("#notice", (text) => text.textContent), /WebGL/);
        assert.ok(await coloursOfView(page) > 8);
        for (const camera of ["above", "magnet", "bead"]) {
            await click(page, `[data-camera=${camera}]`);
            await picture(page, `wide-flat-${camera}`);
        }
        await checkAxe(page, "flat");
        await close(page);
        const still = await open("", { reduced: true });
        assert.equal(await still.evaluate(() => window.festoonLab.lab.playing), false);
        await close(still);
    },
    async "paused, a page does nothing: no frame, no timer; what changes is drawn once"() {
        for (const flat of [false, true]) {
            const page = await open("", { counted: true, flat });
            const count = () => page.evaluate(() => window.callbacks);
            const rest = () => new Promise((resolve) => setTimeout(resolve, 700));
            await described(page);
            const running = await count();
            await page.waitForFunction((before) => window.callbacks > before + 5, { polling: 50, timeout: 0 }, running);
            for (const how of ["#play", "#step", "#restart", "[data-camera=above]"]) {
                if (how === "#play" || await page.evaluate(() => !window.festoonLab.lab.playing))
                    await click(page, how);
                await page.waitForFunction(() => !window.festoonLab.lab.pace.asked, { polling: 50, timeout: 0 });
                const before = await count();
                await rest();
                assert.equal(await count() - before, 0, `idle after ${how}`);
            }
            await click(page, "#lesson-open");
            await described(page);
            await page.waitForFunction(() => !window.festoonLab.lab.pace.asked, { polling: 50, timeout: 0 });
            const before = await count();
            await rest();
            assert.equal(await count() - before, 0, "idle while the lesson asks");
            await close(page);
        }
    },
    async "a lost WebGL context: the flat view, and the other one when it is back"() {
        const page = await open("#v=1&drive.frequency=10.7+Hz&ui.camera=free&ui.settle=20");
        const state = () => page.evaluate(() => {
            const { lab } = window.festoonLab;
            return { flat: lab.camera.flat, mode: lab.camera.mode, shown: lab.view.canvas === document.getElementById("view"), views: document.querySelectorAll("#view").length,
                free: !document.querySelector("[data-camera=free]").hidden, turns: lab.row[1] };
        });
        const before = await state();
        assert.deepEqual([before.flat, before.mode, before.free], [false, "free", true]);
        await page.evaluate(() => {
            window.lost = document.getElementById("view").getContext("webgl2").getExtension("WEBGL_lose_context");
            window.lost.loseContext();
        });
        await page.waitForFunction(() => window.festoonLab.lab.camera.flat, { timeout: 0 });
        const lost = await state();
        assert.deepEqual([lost.mode, lost.shown, lost.views, lost.free], ["above", true, 1, false]);
        assert.match(await page.$eval("#notice", (text) => text.textContent), /from above/);
        assert.ok(await coloursOfView(page) > 8, "the flat view is not blank");
        await page.waitForFunction((turns) => window.festoonLab.lab.row[1] > turns, { timeout: 0 }, lost.turns);
        await picture(page, "wide-context-lost");
        await checkAxe(page, "lost");
        /* Off the page, the lost view must outlive a collection of garbage. */
        await (await page.createCDPSession()).send("HeapProfiler.collectGarbage");
        await page.evaluate(() => window.lost.restoreContext());
        await page.waitForFunction(() => !window.festoonLab.lab.camera.flat, { timeout: 0 });
        const back = await state();
        assert.deepEqual([back.mode, back.shown, back.views, back.free], ["free", true, 1, true]);
        assert.equal(await page.$eval("#notice", (text) => text.textContent), "");
        assert.ok(await coloursOfView(page) > 12, "the view is not blank");
        await picture(page, "wide-context-back");
        await close(page);
    },
    async "start.r=50, in the address or the control: a sentence, and the page lives on; what is good of an address is kept"() {
        const page = await open("#v=1&start.r=50&drive.frequency=14.5+Hz&magnet.depth=1.5+cm&drive.frequncy=3&ui.slow=50");
        const notice = await page.$eval("#notice", (text) => text.textContent);
        assert.match(notice, /start\.r = 50 lies beyond the plate's edge/);
        assert.match(notice, /drive\.frequncy/);
        const state = () => page.evaluate(() => {
            const { lab, core } = window.festoonLab;
            return [core.value("drive.frequency"), core.value("magnet.depth"), core.value("start.r") < 2, lab.settings.slow, location.hash.includes("start.r"), lab.playing];
        });
        assert.deepEqual(await state(), [14.5, 0.015, true, 50, false, true]);
        const lives = async () => {
            const turns = await page.evaluate(() => window.festoonLab.lab.row[1]);
            await page.waitForFunction((before) => window.festoonLab.lab.row[1] > before, { timeout: 0 }, turns);
            assert.ok(await coloursOfView(page) > 12);
        };
        await lives();
        await type(page, "#p-start-r", "50");
        assert.match(await page.$eval("#p-start-r-error", (text) => text.textContent), /edge/);
        assert.deepEqual(await state(), [14.5, 0.015, true, 50, false, true]);
        await lives();
        await type(page, "#p-start-r", "0.5");
        assert.equal(await page.$eval("#p-start-r-error", (text) => text.textContent), "");
        await type(page, "#p-magnet-depth", "1.62 cm");
        assert.equal(await page.evaluate(() => window.festoonLab.core.value("magnet.depth")), 0.0162);
        await type(page, "#p-bead-radius", "0.3cm");
        assert.equal(await page.evaluate(() => window.festoonLab.core.value("bead.radius")), 0.003);
        await lives();
        await close(page);
    },
    async "Back of the browser brings back what an experiment, a lesson, a key or a dropped scene has replaced"() {
        const page = await open("#v=1&drive.frequency=13.25+Hz&magnet.depth=15+mm&ui.slow=50&ui.camera=above");
        const scene = () => page.evaluate(() => JSON.stringify(window.festoonLab.core.scene())), own = await scene();
        const go = async (how) => {
            const hash = await page.evaluate(() => location.hash);
            await page.evaluate((name) => history[name](), how);
            await page.waitForFunction((before) => location.hash !== before, { timeout: 0 }, hash);
            await page.evaluate(() => new Promise((resolve) => setTimeout(resolve)));
        };
        const acts = [() => click(page, "[data-preset=twelve]"), () => click(page, "#lesson-open"), () => page.evaluate(() => document.activeElement.blur()).then(() => page.keyboard.press("5")),
            () => page.evaluate(() => window.festoonLab.lab.files.open(new File(["drive:\n  frequency: 16 Hz\n"], "a.yaml")))];
        for (const act of acts) {
            await act();
            assert.notEqual(await scene(), own);
            await go("back");
            await page.waitForFunction(() => window.festoonLab.lab.lesson.at < 0, { timeout: 0 });
            assert.equal(await scene(), own, String(act));
            assert.deepEqual(await page.evaluate(() => [window.festoonLab.lab.settings.slow, window.festoonLab.lab.camera.mode, window.festoonLab.lab.playing]), [50, "above", true]);
        }
        await click(page, "[data-preset=four]");
        await click(page, "#lesson-open");
        await click(page, "#lesson nav button:last-child");
        await go("back");
        assert.equal(await page.evaluate(() => window.festoonLab.lab.lesson.at), 0);
        await go("back");
        assert.deepEqual(await page.evaluate(() => [window.festoonLab.lab.lesson.at, window.festoonLab.core.value("drive.frequency")]), [-1, 10.7]);
        await go("back");
        assert.equal(await scene(), own);
        await go("forward");
        assert.equal(await page.evaluate(() => window.festoonLab.core.value("drive.frequency")), 10.7);
        await close(page);
    },
    async "a slow device tells how slow the motion really is"() {
        const page = await open("#v=1&drive.frequency=10.7+Hz&ui.slow=1");
        await page.evaluate(() => {
            const { lab } = window.festoonLab, usual = lab.advance;
            lab.advance = (seconds, most) => usual.call(lab, seconds / 4, most); /* a quarter of what is due */
            lab.pace.reset();
        });
        await page.waitForFunction(() => /^[34](\.\d)? times slower, not real time/.test(document.getElementById("slow-value").textContent), { timeout: 0 });
        await picture(page, "wide-slow-device");
        await noSidewaysScroll(page);
        await close(page);
    },
    async "what a pupil reads: a swing is not an error, without friction no exponent but in the details, words for keys"() {
        const page = await open("#v=1&drive.frequency=10.7+Hz");
        await described(page);
        const numbers = await page.$eval("#numbers", (list) => list.textContent);
        assert.match(numbers, /mean distance from the axis17\.63 mmswing of the distance \(root mean square\)3\.85 mm/);
        assert.ok(!numbers.includes("±"));
        await click(page, "[data-preset=none]");
        await page.waitForFunction(() => /^Without friction/.test(document.getElementById("regime").textContent), { timeout: 0 });
        assert.ok(!/Lyapunov|\+-/.test(await page.$eval("#stage", (stage) => stage.innerText)), "nothing of an exponent is seen");
        await click(page, "#why summary");
        assert.match(await page.$eval("#stage", (stage) => stage.innerText), /Lyapunov/);
        const raw = await page.evaluate(() => {
            for (const details of document.querySelectorAll("details"))
                details.open = true;
            return [...document.querySelectorAll("label, option, summary, legend, dt, dd, button")].map((element) => element.innerText)
                .filter((text) => /_|[a-z]\.[a-z]|coulomb|farago|undefined/.test(text));
        });
        assert.deepEqual(raw.filter((text) => !/^n_z/.test(text)), []);
        await picture(page, "wide-none");
        const words = () => page.evaluate(() => [document.querySelector("label[for=p-drive-frequency]").textContent, document.getElementById("p-magnet-depth").checkVisibility(), document.getElementById("legend").textContent,
            [...document.querySelectorAll("#numbers dt")].map((name) => name.textContent).filter((name) => /distance|circles|festoons|symmetry|velocity/.test(name))]);
        await click(page, "[data-preset=wave]");
        await page.waitForFunction(() => /velocity/.test(document.getElementById("numbers").textContent), { timeout: 0 });
        const [name, depth, , rows] = await words();
        assert.deepEqual([name, depth, rows], ["Frequency of the wave", false, ["mean velocity along the wave"]], "nothing of a magnet that turns, nor of its axis");
        const offered = () => page.evaluate(() => ["friction-law", "friction-mu", "magnet-depth"].map((key) => document.getElementById(`p-${key}`).checkVisibility()));
        const pressed = () => page.$$eval("#presets [aria-pressed=true]", (all) => all.map((button) => button.dataset.preset).join());
        assert.equal(await pressed(), "wave");
        await click(page, "[data-preset=levitation]");
        assert.deepEqual(await offered(), [false, false, false], "what floats has no friction and no plate");
        assert.equal(await page.$eval("#p-model-kappa ~ input, .row:has(#p-model-kappa) input[type=range]", (slider) => slider.hidden), true, "no slider where there is no value");
        await page.waitForFunction(() => window.festoonLab.lab.recording.done, { timeout: 0 });
        const tops = await page.evaluate(() => {
            const { lab } = window.festoonLab, { eye } = lab.view, box = document.getElementById("view-box").getBoundingClientRect(), label = document.getElementById("live").getBoundingClientRect().bottom;
            lab.draw();
            eye.updateMatrixWorld();
            const radius = lab.groups.eps, at = (row) => new eye.position.constructor(row[3], row[4], row[35] + radius).project(eye).y;
            return [box.top + (box.height * (1 - Math.max(...lab.recording.samples.map(at)))) / 2, label];
        });
        assert.ok(tops[0] > tops[1], `at no time it leaves the picture, or hides under the words: ${tops}`);
        await click(page, "[data-preset=four]");
        assert.deepEqual(await offered(), [true, false, true], "dry friction alone has a coefficient");
        await type(page, "#p-magnet-depth", "17 mm");
        assert.equal(await pressed(), "");
        await click(page, "[data-preset=dry]");
        assert.deepEqual(await offered(), [true, true, true]);
        await page.evaluate(() => document.querySelectorAll("#main-controls .more").forEach((more) => more.click()));
        const helps = await page.$$eval("#main-controls .help", (all) => all.map((help) => [help.textContent, help.lang]));
        assert.ok(helps.length === 6 && helps.every(([text, lang]) => lang === "" && !/\b[a-z]+\.[a-z_]+:|gamma|mu B0/.test(text)), "its main controls are explained without names of the program");
        await page.waitForFunction(() => /festoons/.test(document.getElementById("numbers").textContent) && /sticks/.test(document.getElementById("legend").textContent), { timeout: 0 });
        assert.deepEqual((await words()).slice(0, 3), ["Speed of the magnet", true, "frictionslipssticks"]);
        await close(page);
    },
    async "the picture fills the screen with its controls, and leaves it"() {
        const page = await open();
        const shown = () => page.evaluate(() => [document.fullscreenElement?.id ?? "", document.getElementById("screen").textContent]);
        const until = (id) => page.waitForFunction((name) => (document.fullscreenElement?.id ?? "") === name, { timeout: 0 }, id);
        assert.deepEqual(await shown(), ["", "Full screen"]);
        await page.click("#screen");
        await until("theatre");
        await page.waitForFunction(() => document.getElementById("screen").textContent === "Leave full screen", { timeout: 0 });
        const share = await page.evaluate(() => document.getElementById("view").getBoundingClientRect().height / window.innerHeight);
        assert.ok(share > 0.7, `${share} of the height`);
        await click(page, "#play");
        await page.setViewport({ width: 900, height: 700 });
        await page.waitForFunction(() => document.getElementById("view").clientWidth < 900, { timeout: 0 });
        assert.ok(await coloursOfView(page, "resize") > 12, "a picture stands there at once");
        await picture(page, "wide-fullscreen");
        await page.evaluate(() => document.activeElement.blur());
        await page.keyboard.press("f");
        await until("");
        await close(page);
    },
    async "on paper: the picture, the numbers and whose they are, and no controls"() {
        const page = await open("#v=1&drive.frequency=14.5+Hz&friction.law=coulomb");
        const dark = () => page.emulateMediaFeatures([{ name: "prefers-color-scheme", value: "dark" }]);
        await dark();
        await described(page);
        const ink = () => page.evaluate(() => window.festoonLab.lab.panels.canvas.ink.text);
        assert.notEqual(await ink(), "#33404d");
        await page.evaluate(() => window.dispatchEvent(new Event("beforeprint")));
        assert.equal(await ink(), "#33404d", "dark ink also where the page is dark");
        await page.emulateMediaType("print");
        await page.setViewport({ width: 720, height: 1000 });
        await page.evaluate(() => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))));
        const seen = await page.evaluate(() => Object.fromEntries(["view", "plot", "numbers", "regime", "paper", "play", "presets", "main-controls", "cameras", "sweep-form", "lesson-open", "screen"].map((id) => [id, document.getElementById(id).checkVisibility()])));
        assert.deepEqual(Object.keys(seen).filter((id) => seen[id]), ["view", "plot", "numbers", "regime", "paper"]);
        assert.match(await page.$eval("#paper", (text) => text.textContent), /Speed of the magnet: 14\.5 Hz; Law of friction: dry.*festoon \d/);
        assert.equal(await page.evaluate(() => getComputedStyle(document.body).backgroundColor), "rgb(255, 255, 255)");
        await picture(page, "paper");
        await page.emulateMediaType("screen");
        await dark(); /* which the media type has taken back */
        await page.evaluate(() => window.dispatchEvent(new Event("afterprint")));
        assert.notEqual(await ink(), "#33404d");
        await close(page);
    },
    async "where memory runs out the page says so and lives on"() {
        const page = await open("#v=1&drive.frequency=12+Hz");
        const refuses = await page.evaluate(() => {
            const { core } = window.festoonLab, taken = [];
            for (let size = 2 ** 29; size >= 16; size /= 2)
                for (let at = core.c.lab_alloc(size); at; at = core.c.lab_alloc(size))
                    taken.push(at);
            window.giveBack = () => taken.forEach((at) => core.c.lab_release(at));
            return taken.length;
        });
        assert.ok(refuses > 0);
        await type(page, "#p-drive-frequency", "13 Hz");
        assert.match(await page.$eval("#p-drive-frequency-error", (text) => text.textContent), /no more memory/);
        const turns = await page.evaluate(() => window.festoonLab.lab.row[1]);
        await page.waitForFunction((before) => window.festoonLab.lab.row[1] > before, { timeout: 0 }, turns);
        await click(page, "#restart");
        assert.match(await page.$eval("#notice", (text) => text.textContent), /no more memory/);
        await page.evaluate(() => window.giveBack());
        await type(page, "#p-drive-frequency", "13 Hz");
        assert.equal(await page.evaluate(() => window.festoonLab.core.value("drive.frequency")), 13);
        await close(page);
        const starved = await browser.newPage(); /* and a page that gets none from the beginning */
        await starved.evaluateOnNewDocument(() => {
            WebAssembly.instantiate = () => Promise.reject(new RangeError("WebAssembly.instantiate(): Out of memory: Cannot allocate Wasm memory for new instance"));
        });
        await starved.goto(PAGE);
        await starved.waitForFunction(() => /no more memory/.test(document.getElementById("notice").textContent), { timeout: 0 });
        await starved.close();
    },
    async "what festoon lab hands to a desktop leads a browser to the page with its scene"() {
        const tools = join(scratch, "bin"), asked = join(scratch, "asked");
        mkdirSync(tools);
        writeFileSync(join(tools, "xdg-open"), '#!/bin/sh\nprintf %s "$1" > "$ASKED.part"\nmv "$ASKED.part" "$ASKED"\n', { mode: 0o755 });
        execFileSync(FESTOON, ["lab", "--set", "drive.frequency=12.5", "--set", "friction.law=coulomb"], {
            stdio: "ignore", env: { ...process.env, DISPLAY: ":9", PATH: `${tools}:${process.env.PATH}`, ASKED: asked, XDG_RUNTIME_DIR: scratch },
        });
        while (!existsSync(asked))
            await new Promise((resolve) => setTimeout(resolve, 5));
        const page = await browser.newPage();
        await page.goto(`file://${readFileSync(asked, "utf8")}`);
        await page.waitForFunction(() => window.festoonLab?.version !== undefined, { timeout: 0 });
        assert.deepEqual(await page.evaluate(() => [window.festoonLab.core.value("drive.frequency"), window.festoonLab.core.get("friction.law")]), [12.5, "coulomb"]);
        await page.close();
    },
    async "within another page, as in a notebook, it works without an address of its own"() {
        const page = await browser.newPage(), complaints = [];
        page.on("pageerror", (error) => complaints.push(error.message));
        await page.goto("about:blank");
        await page.evaluate((text) => {
            const frame = document.createElement("iframe");
            frame.width = frame.height = "700";
            frame.srcdoc = text;
            document.body.append(frame);
        }, readFileSync(join(BUILD_DIR, "festoon-lab.html"), "utf8").replace("<head>", '<head><script>window.location.hash = "#v=1&drive.frequency=13.5";</script>'));
        await page.waitForFunction(() => window.frames[0].festoonLab?.version !== undefined, { timeout: 0 });
        assert.equal(await page.evaluate(() => window.frames[0].festoonLab.core.value("drive.frequency")), 13.5);
        assert.equal(await page.evaluate(() => window.frames[0].festoonLab.run({ "run.periods": 20 }).then((result) => result.periods)), 20);
        await page.close();
        assert.deepEqual(complaints, []);
    },
    async "what is saved: the motion, the scene"() {
        const page = await open("#v=1&drive.frequency=12+Hz&ui.settle=20");
        const { table, scene } = await page.evaluate(() => {
            const { lab } = window.festoonLab, saved = [];
            URL.createObjectURL = (blob) => {
                saved.push(blob);
                return "data:,";
            };
            HTMLAnchorElement.prototype.click = () => {};
            document.getElementById("save-csv").click();
            document.getElementById("save-scene").click();
            return Promise.all(saved.map((blob) => blob.text())).then(([a, b]) => ({ table: a, scene: b, lab: Boolean(lab) }));
        });
        const lines = table.trim().split("\n");
        assert.match(lines[0], /^t \[s\],turns,x \[mm\]/);
        assert.ok(lines.length > 200);
        assert.match(scene, /drive:\n {2}frequency: 12 Hz/);
        await close(page);
    },
};

let failed = 0;
const wanted = process.argv[2];
try {
    for (const [name, test] of Object.entries(tests)) {
        if (wanted && !name.includes(wanted))
            continue;
        try {
            await test();
            console.log(`ok: ${name}`);
        } catch (error) {
            failed += 1;
            console.log(`FAILED: ${name}\n${error.stack}`);
        }
    }
} finally {
    await browser.close();
    rmSync(scratch, { recursive: true, force: true });
}
process.exit(failed ? 1 : 0);
