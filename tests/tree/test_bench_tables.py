"""Tables of the benchmark's figures (bench/tables.py), and how its instructions are counted (bench/ports.py).

labels: tree"""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

BENCH = pathlib.Path(os.environ["SOURCE_DIR"]) / "bench"
sys.dont_write_bytecode = True
sys.path.insert(0, str(BENCH))
import ports  # noqa: E402

FIGURES = "costs\tavx2, rows\t1e-09\t2.5\ncosts\tavx2, rows\tms\t3e-07\ncosts\tnew\tms\t1\nother\tx\ty\t22.4 %\n"
PAGE = """# Costs

| costs | ms | copied | 1e-9 |
|---|---|---|---|
| avx2, rows | 1 | 8 | |
| scalar | 4 | 5 | 6 |

| nothing | ms |
|---|---|
| avx2, rows | 7 |
"""
FILLED = PAGE.replace("| avx2, rows | 1 | 8 | |", "| avx2, rows | 3e-7 | 8 | 2.5 |")


class Tables(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.write("figures.tsv", FIGURES)

    def write(self, name, text):
        (self.folder / name).write_text(text, encoding="utf-8")

    def tables(self, what, name):
        subprocess.run([sys.executable, "-B", BENCH / "tables.py", self.folder / "figures.tsv", self.folder / "errors.csv",
                        what, self.folder / name], check=True, capture_output=True)
        return (self.folder / name).read_text(encoding="utf-8")

    def test_a_page_keeps_its_rows_and_columns(self):
        self.write("page.md", PAGE)
        self.assertEqual(self.tables("--fill", "page.md"), FILLED)
        self.assertEqual(self.tables("--fill", "page.md"), FILLED)

    def test_all_tables(self):
        text = self.tables("-o", "all.md")
        self.assertIn("| costs | 1e-9 | ms |\n|---|---|---|\n| avx2, rows | 2.5 | 3e-7 |\n| new |  | 1 |\n", text)
        self.assertIn("| other | y |\n|---|---|\n| x | 22.4 % |\n", text)

    def test_times_between_tolerances(self):
        """A power law is met exactly; nothing is said beyond the measured errors."""
        lines = [f"power,{10.0 ** -e:.3e},{10.0 ** -e:.3e},{2.0 * 10.0 ** (e / 8):.9f}\n" for e in (3, 5, 10)]
        self.write("errors.csv", "solver,tolerance,error,ms\n" + "".join(lines))
        times = [2.0 * 10.0 ** (e / 8) for e in (4, 6, 9)]
        self.assertIn("| power | " + " | ".join(f"{ms:.3g}" for ms in times) + " |  |", self.tables("-o", "all.md"))


class Ports(unittest.TestCase):
    def test_kinds(self):
        arithmetic, slow = "arithmetic on vectors", "of these, roots, quotients and estimates"
        loads, stores = "loads of vectors", "stores of vectors"
        for text, kinds in (
                ("vfmadd231pd 0x40(%rsp),%zmm1,%zmm2", [loads, arithmetic]),
                ("vfmadd231pd 0x40(%rsp,%rax,8){1to8},%zmm1,%zmm2", [loads, arithmetic]),
                ("vmulpd %zmm1,%zmm2,%zmm3", [arithmetic]),
                ("vrsqrt14pd %zmm1,%zmm2", [arithmetic, slow]),
                ("vdivps %xmm1,%xmm2,%xmm3", [arithmetic, slow]),
                ("vmovapd %zmm1,0x80(%rdi)", [stores]),
                ("vmovapd 0x80(%rdi),%zmm1", [loads]),
                ("vmovapd %zmm1,%zmm2", []),
                ("vbroadcastsd 0x12(%rip),%zmm4        # 1234 <x>", [loads]),
                ("vblendvpd %ymm0,%ymm1,%ymm2,%ymm3", [arithmetic]),
                ("mov 0x8(%rsp),%rax", ["others"]),
                ("vzeroupper", ["others"])):
            mnemonic, _, operands = text.partition(" ")
            self.assertEqual(ports.kind_of(mnemonic, operands), kinds, text)


if __name__ == "__main__":
    unittest.main()
