"""A minute of libFuzzer on the scene reader and less on the other readers, from the corpora of tests/fuzz, under the
address and undefined behaviour sanitizers.  Skipped where clang has no libFuzzer.

Environment: SOURCE_DIR is the source tree.  FESTOON_FUZZ_SECONDS: how long the scene reader is fuzzed.
"""

import glob
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

SOURCE = os.environ["SOURCE_DIR"]
SECONDS = int(os.environ.get("FESTOON_FUZZ_SECONDS", "60"))
TARGETS = {"scene": SECONDS, "over": SECONDS // 3, "csv": SECONDS // 6, "branch": SECONDS // 6}


def run(*words, **options):
    return subprocess.run(words, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, **options)


def has_fuzzer():
    if not shutil.which("clang"):
        return False
    with tempfile.TemporaryDirectory() as folder:
        source = os.path.join(folder, "empty.c")
        with open(source, "w", encoding="ascii") as out:
            out.write("int LLVMFuzzerTestOneInput(const unsigned char *d, unsigned long n) { return d && n ? 0 : 0; }\n")
        return run("clang", "-fsanitize=fuzzer,address,undefined", source, "-o", source + ".x").returncode == 0


class Fuzzing(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory(prefix="festoon-fuzz-")
        self.addCleanup(holder.cleanup)
        self.directory = holder.name

    def done(self, *words, **options):
        result = run(*words, **options)
        self.assertEqual(result.returncode, 0, result.stdout.decode(errors="replace")[-4000:])
        return result.stdout.decode(errors="replace")

    def build(self):
        """The targets, linked with libFuzzer to libraries that tell it of their branches."""
        tree = os.path.join(self.directory, "build")
        self.done("cmake", "-S", SOURCE, "-B", tree, "-G", "Ninja", "-DCMAKE_C_COMPILER=clang", "-DCMAKE_BUILD_TYPE=Debug",
                  "-DCMAKE_C_FLAGS_DEBUG=-O1 -g", "-DFESTOON_SANITIZE=address,undefined,fuzzer-no-link")
        self.done("cmake", "--build", tree, "--target", "festoon_internal", timeout=900)
        archive, = glob.glob(os.path.join(tree, "**", "libfestoon_internal.a"), recursive=True)
        libraries = self.done("pkg-config", "--libs", "yaml-0.1", "jansson", "sqlite3").split()
        for name in TARGETS:
            self.done("clang", "-std=c11", "-D_POSIX_C_SOURCE=200809L", "-Werror", "-O1", "-g",
                      "-fsanitize=fuzzer,address,undefined",
                      "-fno-sanitize-recover=all", "-I", os.path.join(SOURCE, "include"), "-I",
                      os.path.join(SOURCE, "src"), os.path.join(SOURCE, "tests", "fuzz", f"fuzz_{name}.c"), archive,
                      *libraries, "-lm", "-ldl", "-lpthread", "-o", os.path.join(self.directory, name))

    def test_a_minute(self):
        self.build()
        for name, seconds in TARGETS.items():
            with self.subTest(target=name):
                corpus = os.path.join(self.directory, name + "-corpus")
                shutil.copytree(os.path.join(SOURCE, "tests", "fuzz", name), corpus)
                text = self.done(os.path.join(self.directory, name), corpus, f"-max_total_time={seconds}", "-timeout=10",
                                 "-rss_limit_mb=1024", "-max_len=4096", "-print_final_stats=1", cwd=self.directory)
                runs = [line.split()[1] for line in text.splitlines() if "number_of_executed_units" in line]
                self.assertGreater(int(runs[0]), 1000, text[-2000:])
                print(f"{name}: {runs[0]} inputs in {seconds} s")


if __name__ == "__main__":
    if not has_fuzzer():
        print("skipped: no clang with libFuzzer (clang, libclang-rt-14-dev)")
        sys.exit(77)
    unittest.main()
