"""What `festoon paper` writes: tests that test_paper_reduced_long.py runs on its one run of the paper."""

import html
import json
import math
import os
import re
import shutil
import subprocess
import unittest
from concurrent.futures import ThreadPoolExecutor
from html.parser import HTMLParser

from paper_by_hand import repeat, run

VERDICTS = {"reproduced", "close", "not reproduced"}


def read_off(expression, printed):
    """Reads a number as paper.json says: by an expression in the keys of the command's output."""
    return eval(expression, {"__builtins__": {}, "abs": abs, "max": max}, printed)


class Tags(HTMLParser):
    """Checks that every tag is closed, in order, and collects what the page loads from other places."""
    EMPTY = {"meta", "br", "img", "link", "hr", "input"}

    def __init__(self):
        super().__init__()
        self.open, self.faults, self.ids, self.loads = [], [], [], []

    def handle_starttag(self, tag, attributes):
        named = dict(attributes)
        self.loads += [named[key] for key in ("src", "href", "action", "data") if key in named]
        self.ids += [named["id"]] if "id" in named else []
        if tag not in self.EMPTY:
            self.open.append(tag)

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            self.faults.append((tag, self.getpos()))


FRAME = """<iframe id="page" src="{1}/report.html" style="border:0;width:{0}px;height:900px"></iframe><pre id="said"></pre>
<script>onload = () => {{
  const page = document.getElementById("page").contentDocument;
  const wide = [...page.querySelectorAll("*")].filter(e => e.getBoundingClientRect().right > {0} + 1).map(e => e.outerHTML);
  document.getElementById("said").textContent = JSON.stringify([page.documentElement.scrollWidth, wide.slice(0, 3)]);
}}</script>"""


class Report:
    """For a test case that has `paper`, the object of paper.json, `directory`, `summary`, what was printed, `report`, the
    page, `films`, whether there are any, close_to() and statement()."""

    def test_the_list_has_every_statement(self):
        done = run("paper", "--statements")
        self.assertEqual(done.returncode, 0, done.stderr)
        rows = done.stdout.split("\n\n")[1].splitlines()[2:]
        self.assertEqual([row.split(" | ")[1] for row in rows], [s["statement"] for s in self.paper["statements"]])

    def test_verdicts_follow_their_rules(self):
        """Each verdict, decided again by the rules of docs/paper.md from value, published value and scale alone."""
        def rule(name, value, published, scale):
            if name in ("never", "symmetry"):
                return "reproduced" if value == published else "not reproduced"
            if value is None:
                return "not reproduced"
            if name == "several":
                return "reproduced" if value >= 2 else "not reproduced"
            if name in ("notable", "mostly"):
                least = {"notable": (0.1, 0.03), "mostly": (0.5, 0.25)}[name]
                passed = [value >= share * scale for share in least]
            elif name == "magnitude":
                passed = [abs(math.log10(value / published)) <= orders for orders in (0.5, 1.0)]
            elif name in ("number", "limit"):
                off = value - published if name == "limit" else abs(value - published)
                passed = [off <= 0.5 * scale, off <= max(0.5 * scale, min(10 * scale, 0.2 * abs(published)))]
            else:
                shares = {"small": (0.1, 0.3), "law": (1e-6, 1e-3)}[name]
                passed = [abs(value - published) <= share * scale for share in shares]
            return "reproduced" if passed[0] else "close" if passed[1] else "not reproduced"
        met = set()
        for statement in self.paper["statements"]:
            name = re.match(r"\w+", statement["criterion"])[0]
            for dynamics, key in (("farago2020", "verdict"), ("rigid", "rigid_verdict"), ("coulomb", "coulomb_verdict")):
                if dynamics not in statement:
                    continue
                expected = rule(name, statement[dynamics], statement["published"], statement["scale"])
                self.assertEqual(statement[key], expected, statement)
                met.add((name, expected))
            second = statement["second_reading"] or {}
            for dynamics, key in (("farago2020", "verdict"), ("rigid", "rigid_verdict"), ("coulomb", "coulomb_verdict")):
                if dynamics in second:
                    name = re.match(r"\w+", second["criterion"])[0]
                    self.assertEqual(second[key], rule(name, second[dynamics], second["published"], second["scale"]),
                                     statement["id"])
        self.assertGreater(len(met), 15)
        # The natural scale is not a free choice: it is one unit of the last digit, or follows from the unit.
        for statement in self.paper["statements"]:
            if re.match("small|notable|mostly", statement["criterion"]):
                usual = {"%": 100, "deg": 90}.get(statement["unit"], max(abs(statement["published"] or 0), 0.5) or 1)
                self.assertIn(statement["scale"], (usual, 1), statement)

    def test_provenance(self):
        provenance = self.paper["provenance"]
        self.assertLessEqual({"version", "scene", "rtol", "periods", "discard", "machine", "parts", "seconds", "processor_seconds"},
                             provenance.keys())
        self.assertLessEqual({"runs", "figures", "periodic orbits", "paramagnetic beads"}, provenance["parts"].keys())
        computing = sum(seconds for part, seconds in provenance["parts"].items() if part != "films")
        self.assertTrue(0 < computing <= provenance["seconds"])
        self.assertGreater(provenance["processor_seconds"], 0.0)
        self.assertIn(f"{provenance['processor_seconds']:.0f} s of processor time", self.report)
        for text in (provenance["version"], html.escape(provenance["machine"]), "model.dynamics", "1e-10"):
            self.assertIn(text, self.report)

    def test_what_is_no_claim_of_the_paper_is_not_counted(self):
        self.assertEqual([s["id"] for s in self.paper["statements"] if not s["claim"]], ["euler-equation", "energy",
                                                                                              "rolling-identity"])
        claims = [s for s in self.paper["statements"] if s["claim"]]
        moving = [s for s in claims if not s["same_for_both"]]
        still = [s for s in claims if s["same_for_both"]]
        words = ("reproduced", "close", "not reproduced")
        counted = [sum(s[key] == v for s in moving) for key in ("verdict", "rigid_verdict") for v in words]
        tally = "{} statements about motions: farago2020 {} reproduced, {} close, {} not; rigid {}, {}, {}"
        self.assertIn(tally.format(len(moving), *counted), self.summary)
        once = [sum(s["verdict"] == v for s in still) for v in words]
        tally = "{} statements into which no motion enters: {} reproduced, {} close, {} not"
        self.assertIn(tally.format(len(still), *once), self.summary)
        for statement in still:
            self.assertEqual((statement["farago2020"], statement["verdict"]),
                             (statement["rigid"], statement["rigid_verdict"]), statement["id"])
        dry = [s["coulomb_verdict"] for s in claims if "coulomb" in s]
        counted = [dry.count(v) for v in words]
        self.assertIn("{} of the first with dry friction, mu = 0.2: {}, {}, {}".format(len(dry), *counted), self.summary)
        # The table of the report has the same numbers, group by group.
        rows = dict(re.findall(r'<tr><td><a href="#group-\d">([^<]*)</a></td>(.*?)</tr>', self.report))
        self.assertEqual(len(rows), 5)
        whole = [re.findall(r"(\d+) · (\d+) · (\d+)", row) for row in rows.values()]
        self.assertEqual(sum(int(n) for row in whole for triple in row for n in triple), 2 * len(moving) + len(still))

    def test_keys(self):
        for statement in self.paper["statements"]:
            self.assertLessEqual({"section", "published", "farago2020", "rigid", "verdict"}, statement.keys())
            self.assertIn(statement["verdict"], VERDICTS)
            self.assertIn(statement["rigid_verdict"], VERDICTS)
        names = [statement["id"] for statement in self.paper["statements"]]
        self.assertEqual(len(names), len(set(names)))

    def test_figures(self):
        figures = self.paper["figures"]
        self.assertGreaterEqual(len(figures), 22)
        for figure in figures:
            path = self.directory / figure["file"]
            self.assertTrue(path.read_text().rstrip().endswith("</svg>"), figure)
            self.assertTrue(path.with_suffix(".gp").is_file() and path.with_suffix(".dat").is_file())
            self.assertIn(figure["verdict"], VERDICTS | {None})

    def test_a_badge_is_the_figures_own(self):
        """A figure has the verdict of the statement that says what it shows, not of the worst one about it."""
        own = {"evolution": "friction", "magint": "magint-least", "f4detail-angle": "fold4-angle", "portrait": "maxima",
               "supercritical": "halving"}
        for name, statement in own.items():
            for key, ending in (("verdict", "farago2020"), ("rigid_verdict", "rigid")):
                found = [f[key] if f["dynamics"] is None else f["verdict"] for f in self.paper["figures"]
                         if f["name"] in (name, f"{name}-{ending}")]
                self.assertEqual(found, [self.statement(statement)[key]], (name, ending))
        self.assertEqual(self.statement("pull-weakens")["verdict"], "not reproduced")
        caption = re.search(r"<figcaption>(Radius and field strength.*?)</figcaption>", self.report, re.S)[1]
        self.assertIn("force on the bead weakest", caption)

    def test_nothing_half_made_stays(self):
        endings = {path.suffix for path in self.directory.iterdir()}
        self.assertEqual(endings - {".mp4"}, {".svg", ".gp", ".dat", ".json", ".html"})

    def test_films(self):
        """The supplement's two films are named in their places and nowhere else."""
        self.assertEqual(self.paper["films"], ["film_0215.mp4", "film_04.mp4"] if self.films else [])
        self.assertEqual(sorted(path.name for path in self.directory.glob("*.mp4")), self.paper["films"])
        for name in self.paper["films"]:
            self.assertIn(b"ftyp", (self.directory / name).read_bytes()[:12])
            self.assertIn(name, self.report)

    def test_the_report_needs_nothing_else(self):
        """The page is well-formed, every name occurs once, and nothing is loaded from other places."""
        page = Tags()
        page.feed(self.report)
        self.assertEqual((page.open, page.faults), ([], []))
        self.assertEqual(len(page.ids), len(set(page.ids)))
        self.assertEqual(self.report.count("<img "), len(self.paper["figures"]))
        for load in page.loads:
            self.assertTrue(load.startswith(("data:image/svg+xml,", "#")), load[:60])
            if load.startswith("#"):
                self.assertIn(load[1:], page.ids)
        for outside in ("<script", "@import", "url("):
            self.assertNotIn(outside, re.sub(r'src="data:[^"]*"', "", self.report))
        self.assertNotRegex(self.report, r"url\((?!'?%23)")  # in a figure, of itself alone
        for figure in self.paper["figures"]:
            self.assertNotRegex((self.directory / figure["file"]).read_text(), r'(?:href|src)="(?!#)')

    def test_the_report_begins_with_what_was_found(self):
        found = self.report.index('id="found"')
        for later in ("tally", "table1", "statements", "figures", "dry"):
            self.assertLess(found, self.report.index(f'id="{later}"'), later)
        chapter = html.unescape(self.report[found:self.report.index('id="reading"')])
        for words in ("gyroscopic term", "misprinted", "no chaos", "fold", "other way round", "last step", "Dry friction"):
            self.assertIn(words, chapter)
        self.assertNotIn("nan", chapter)
        order = [self.report.index(f'id="group-{i}"') for i in range(1, 6)]
        self.assertEqual(order, sorted(order))
        for statement in self.paper["statements"]:
            card = self.report.index(f'id="{statement["id"]}"')
            group = max(i for i in range(5) if order[i] < card)
            names = ["errors in the paper", "model against experiment", "depends on the reading", "arithmetic",
                     "model and theory"]
            self.assertEqual(statement["group"], names[group], statement["id"])

    def test_figures_stand_beside_their_claims(self):
        """A figure follows the card of the claim that judges it, both dynamics side by side; no sentence is a diary."""
        for own, name in (("fold4-festoons", "f4"), ("fold15-closed", "om04-n"), ("friction", "evolution"), ("maxima", "portrait")):
            after = self.report.split(f'<section class="card" id="{own}">')[1].split("</section>", 1)[1]
            until = after.split('<section class="card"')[0]
            ids = re.findall(r'<div id="figure-([^"]*)">', until)
            wanted = [name] if name == "portrait" else [f"{name}-farago2020", f"{name}-rigid"]
            self.assertEqual([i for i in ids if i.startswith(name)][: len(wanted)], wanted)
            if len(wanted) == 2:
                both = next(pair for pair in until.split('<div class="pair">') if f'id="figure-{wanted[0]}"' in pair)
                self.assertIn(f'id="figure-{wanted[1]}"', both)
        prose = re.sub(r'src="data:[^"]*"|<pre>.*?</pre>', "", self.report, flags=re.S)
        self.assertNotRegex(prose, r"[Uu]ntil (?:\d+ )?[A-Z][a-z]+ 20\d\d|on \d+ [A-Z][a-z]+ 20\d\d")

    def test_the_report_is_small_and_says_nothing_twice(self):
        self.assertLess(len(self.report.encode()), 2_000_000)
        text = re.sub(r'src="data:[^"]*"', "", self.report)
        text = re.sub(r"<(style|pre|title)\b.*?</\1>", " ", text, flags=re.S)
        text = re.sub(r'<p class="fine rule">.*?</p>', " ", text, flags=re.S)  # borders of a rule
        text = re.sub(r"<p class=\"fine note\">[^<]*undecided:[^<]*</p>", " ", text)  # what a run says of itself
        text = re.sub(r"<(?!/?(?:b|em|a|small|code|span|strong|sub)\b)[^>]*>", "\n", text)
        text = html.unescape(re.sub(r"<[^>]*>", "", text))
        seen, twice = set(), set()
        for sentence in re.split(r"\n|(?<=[.:;]) ", text):
            sentence = sentence.strip(" .;:")
            if len(sentence.split()) >= 7:
                (twice if sentence in seen else seen).add(sentence)
        self.assertEqual(twice, set())
        self.assertGreater(len(seen), 200)

    def test_what_is_printed_has_no_more_digits_than_the_paper(self):
        printed = {s["id"]: s["printed"] for s in self.paper["statements"]}
        self.assertEqual([printed[i] for i in ("maxima", "fold15-festoons", "eps", "length", "spacing", "magint-field",
                                               "halving")],
                         ["41 mm", "15", "0.11", "0.82", "0.435", "0.89 ℓ", "0.2904"])
        for name, text in printed.items():
            self.assertNotRegex(text, r"\.\d*0\b|e[+-]\d", name)

    def test_commands_repeat_the_numbers(self):
        """Each command of paper.json prints the number that stands beside it; the report shows the same.
        FESTOON_PAPER=reduced runs every fourth of the commands that compute one number by `festoon paper`, and all others."""
        shown = [html.unescape(text) for text in re.findall(r"<pre>(festoon [^<]*)</pre>", self.report)]
        cases = [(s, prefix, dynamics) for s in self.paper["statements"]
                 for prefix, dynamics in (("", "farago2020"), ("rigid_", "rigid"), ("coulomb_", "coulomb"))
                 if dynamics in s]
        commands = sorted({s[prefix + "command"] for s, prefix, _ in cases})
        self.assertGreater(len(commands), 70)
        if os.environ.get("FESTOON_PAPER") == "reduced":
            alone = [command for command in commands if command.startswith("festoon paper --only ")]
            commands = sorted({*commands} - {*alone} | {*alone[::4]})
        with ThreadPoolExecutor(2) as pool:
            printed = dict(zip(commands, pool.map(repeat, commands)))
        for statement, prefix, dynamics in cases:
            command, reads = statement[prefix + "command"], statement[prefix + "reads"]
            if not prefix:
                self.assertIn(f"{command}   # {reads}", shown)
            if command not in printed:
                continue
            value = read_off(reads, printed[command])
            if isinstance(value, str) or value is None:
                self.assertEqual(value, statement[dynamics], (command, reads))
            else:
                self.close_to(value, statement[dynamics], 1e-12, (command, reads))

    @unittest.skipUnless(shutil.which("chromium"), "there is no chromium")
    def test_nothing_is_wider_than_a_phone(self):
        """In a browser, 390 pixels wide, no part of the report reaches beyond the edge."""
        for width in (390, 1000):
            (self.directory.parent / "frame.html").write_text(FRAME.format(width, self.directory.name))
            page = subprocess.run(["chromium", "--headless", "--no-sandbox", "--disable-gpu",
                                   "--allow-file-access-from-files", f"--user-data-dir={self.directory.parent}/browser",
                                   "--virtual-time-budget=20000", "--dump-dom", f"file://{self.directory.parent}/frame.html"],
                                  capture_output=True, text=True).stdout
            said = json.loads(html.unescape(re.search(r'<pre id="said">(.*?)</pre>', page, re.S)[1]))
            self.assertLessEqual(said[0], width, said)
            self.assertEqual(said[1], [])
