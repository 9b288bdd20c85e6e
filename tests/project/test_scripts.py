#!/usr/bin/env python3
"""Tests of the project's own scripts: each check must find what it is there to find."""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent


def run(script, *arguments, env=None):
    done = subprocess.run([sys.executable, str(ROOT / script), *map(str, arguments)], text=True, capture_output=True, env=env)
    return done.returncode, done.stdout + done.stderr


class Tree(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.root = Path(self.temporary.name)
        self.write("include/abut/contact/surface.hpp", "#pragma once\n#include <vector>\n")
        self.write("src/core/id.hpp", "#pragma once\n")
        self.write("src/cycle/sink.hpp", "#pragma once\n#include \"abut/contact/surface.hpp\"\n")
        self.write("src/contact/search/tree.hpp", "#pragma once\n#include <abut/contact/surface.hpp>\n")

    def tearDown(self):
        self.temporary.cleanup()

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)


class IncludeDirections(Tree):
    def check(self):
        return run("scripts/check_includes.py", self.root)

    def test_a_clean_tree_passes(self):
        self.assertEqual(self.check()[0], 0, self.check()[1])

    def refused(self, name, text, words):
        self.write(name, text)
        status, output = self.check()
        self.assertEqual(status, 1, output)
        self.assertIn(words, output)

    def test_contact_sees_only_itself(self):
        self.refused("src/contact/a.cpp", "#include \"core/id.hpp\"\n", "src/contact/a.cpp:1: core/id.hpp: contact/ includes")

    def test_contact_sees_no_library(self):
        self.refused("src/contact/a.cpp", "#include <fmt/format.h>\n", "contact/ includes include/abut, simd/ and itself only")

    def test_nobody_sees_inside_contact(self):
        self.refused("src/cycle/a.cpp", "\n#include \"contact/search/tree.hpp\"\n", "a.cpp:2:")

    def test_cycle_does_not_know_output(self):
        self.write("src/output/csv.hpp", "#pragma once\n")
        self.refused("src/cycle/a.cpp", "#include \"output/csv.hpp\"\n", "cycle/ comes before output/")

    def test_output_may_know_cycle(self):
        self.write("src/output/csv.hpp", "#pragma once\n#include \"cycle/sink.hpp\"\n")
        self.assertEqual(self.check()[0], 0)

    def test_only_parallel_uses_mpi(self):
        self.write("src/parallel/ranks.cpp", "#include <mpi.h>\n")
        self.assertEqual(self.check()[0], 0)
        self.refused("src/cycle/a.cpp", "#include <mpi.h>\n", "MPI is used in src/parallel/ only")

    def test_public_headers_stay_public(self):
        self.refused("include/abut/run.hpp", "#include \"core/id.hpp\"\n", "a public header includes the standard library")

    def test_a_commented_include_is_none(self):
        self.write("src/contact/a.cpp", "// #include \"core/id.hpp\"\n/*\n#include \"core/id.hpp\"\n*/\n")
        self.assertEqual(self.check()[0], 0)

    def test_a_long_file_is_a_warning(self):
        self.write("src/core/long.cpp", "\n" * 501)
        status, output = self.check()
        self.assertEqual(status, 0)
        self.assertIn("src/core/long.cpp: warning: 501 lines", output)

    def test_a_stage_that_is_none(self):
        self.refused("src/utils/a.cpp", "", "is in no stage")


class Objects(Tree):
    def build(self, target, text, *flags):
        self.write(f"{target}.cpp", text)
        folder = self.root / "CMakeFiles" / f"{target}.dir"
        folder.mkdir(parents=True)
        subprocess.run(["c++", "-std=c++20", "-O1", *flags, "-c", str(self.root / f"{target}.cpp"), "-o", str(folder / "a.o")], check=True)

    def check(self, *arguments):
        return run("scripts/check_isa_objects.py", self.root, *arguments)

    def test_a_clean_kernel_passes(self):
        kernel = "#include <cmath>\nnamespace abut::elements::avx2 { double f(double a) { return std::sqrt(a) + 1; } }\n"
        self.build("abut_elements_avx2", kernel)
        self.assertEqual(self.check()[0], 0, self.check()[1])

    def test_a_library_function_is_found(self):
        self.build("abut_elements_avx2", "#include <vector>\nnamespace abut { void f(std::vector<int>& v, int k) { v.insert(v.begin(), 3, k); } }\n")
        status, output = self.check()
        self.assertEqual(status, 1)
        self.assertIn("not of namespace abut", output)

    def test_a_shared_inline_function_is_found(self):
        text = "namespace abut { template <class T> [[gnu::noinline]] T twice(T a) { return a + a; } double NAME(double a) { return twice(a); } }\n"
        self.build("abut_elements_avx2", text.replace("NAME", "f"))
        self.assertEqual(self.check()[0], 0)
        self.build("abut_elements", text.replace("NAME", "g"))
        status, output = self.check()
        self.assertEqual(status, 1)
        self.assertIn("weakly, and so do objects of: common", output)

    def test_the_maths_library_is_found(self):
        self.build("abut_contact", "#include <cmath>\nnamespace abut { double f(double a) { return std::pow(a, 1.5); } }\n")
        self.assertEqual(self.check()[0], 0)
        status, output = self.check("--state-path", "contact")
        self.assertEqual(status, 1)
        self.assertIn("imports pow", output)


class Summary(Tree):
    def test_it_reads_the_last_row_and_the_extremes(self):
        self.write("x_th.csv", "time,GLOBAL/IE,GLOBAL/KE,GLOBAL/ERR,INTER/1/FNX,INTER/1/FNY,INTER/1/FNZ,INTER/1/NC\n"
                               "0,0,10,0,0,0,0,0\n1,4,6,-0.02,3,0,4,7\n2,1,9,0.001,0,0,0,0\n")
        status, output = run("scripts/summarise_run.py", self.root)
        self.assertEqual(status, 0)
        self.assertIn("largest normal force 5 at time 1", output)
        self.assertIn("worst -2.0000% at time 1", output)
        self.assertRegex(output, r"kinetic energy at the start +10\n")
        self.assertIn("up to 7 nodes", output)
        self.assertIn("Outcome: not known", output)

    def test_a_run_that_went_wrong_does_not_look_finished(self):
        self.write("x_th.csv", "time,GLOBAL/IE,GLOBAL/KE,GLOBAL/ERR,INTER/1/FNX,INTER/1/FNY,INTER/1/FNZ\n"
                               "0,0,10,0,0,0,0\n1,4,6,-0.02,3,0,4\n2,1,inf,nan,nan,0,0\n")
        self.write("run.json", '{"outcome": {"kind": "failed", "message": "the kinetic energy is not finite"}}')
        status, output = run("scripts/summarise_run.py", self.root)
        self.assertEqual(status, 0)
        self.assertIn("Outcome: failed: the kinetic energy is not finite\n", output)
        self.assertIn("worst not finite at time 2\n", output)
        self.assertIn("largest 10   not finite at time 2\n", output)
        self.assertIn("largest normal force 5 at time 1   not finite at time 2\n", output)
        for kind, words in (("running", "not ended"), ("interrupted", "interrupted"), ("finished", "finished")):
            self.write("run.json", '{"outcome": {"kind": "%s"}}' % kind)
            self.assertIn(f"Outcome: {words}", run("scripts/summarise_run.py", self.root)[1])

    def test_an_empty_folder_is_an_error(self):
        self.assertEqual(run("scripts/summarise_run.py", self.root)[0], 1)


class Documentation(Tree):
    def setUp(self):
        super().setUp()
        self.write("docs/index.md", "# Start here\n[more](more.md#a-second-heading)\n")
        self.write("docs/more.md", "# More\n## A second heading\n[Flanagan 1981]\n```\n[x](nowhere.md)\n```\n")
        self.write("docs/references.bib", "@article{Flanagan1981, title = {x}}\n@article{Bridson2002, title = {x}}\n")
        self.write("src/core/id.hpp", "// [Bridson et al. 2002; Flanagan 1981, eq. 3]\n")

    def check(self):
        return run("scripts/check_docs.py", self.root)

    def test_a_clean_tree_passes(self):
        self.assertEqual(self.check()[0], 0, self.check()[1])

    def refused(self, name, text, words):
        self.write(name, text)
        status, output = self.check()
        self.assertEqual(status, 1, output)
        self.assertIn(words, output)

    def test_a_broken_link(self):
        self.refused("docs/more.md", "# More\n## A second heading\n[x](gone.md)\n", "docs/more.md:3: gone.md: no such file")

    def test_a_broken_anchor(self):
        self.refused("docs/more.md", "# More\n", "no such heading")

    def test_a_page_that_nothing_links(self):
        self.refused("docs/lost.md", "# Lost\n", "docs/lost.md: not reached")

    def test_an_unknown_reference(self):
        self.refused("src/core/id.hpp", "// [Flanagan 1981; Nobody 1999]\n", "src/core/id.hpp:1: [Nobody 1999] is not in")


class StatementTable(unittest.TestCase):
    def test_statements_are_found_where_tests_name_them(self):
        sys.path.insert(0, str(ROOT / "tools"))
        import statement_table
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "test_x.cpp"
            path.write_text("// All of it is about T9.\n#include <x>\n\nstruct T5 {};\n\n// T7: shapes\nTEST(Shape, Aspect) {\n}\n\n"
                            "TEST(Stiffness, T16_shell) {\n  // T13, T17..T18\n}\nTEST(Other, Nothing) { T2_like(); }\n")
            found = statement_table.tests_of(path)
            self.assertEqual(found[7], ["Shape.Aspect"])
            for number in (13, 16, 17, 18):
                self.assertEqual(found[number], ["Stiffness.T16_shell"], number)
            self.assertEqual(len(found[9]), 1)
            self.assertEqual(set(found), {7, 9, 13, 16, 17, 18})


class DocumentationCode(unittest.TestCase):
    def setUp(self):
        sys.path.insert(0, str(ROOT / "scripts"))
        import check_docs_code
        self.module = check_docs_code

    def test_blocks_with_their_directives(self):
        text = "<!-- code: fails -->\n```sh\nfalse\n```\n\n    indented\n\n- list\n\n    of it\n"
        found = [(block.language, block.directive, block.line) for block in self.module.blocks_of("p.md", text)]
        self.assertEqual(found, [("sh", "fails", 2), ("indented", "", 6)])

    def test_output_is_compared(self):
        differs = self.module.output_differs
        self.assertIsNone(differs("a   1...3\n...\nend", "a 12x3\nb\nc\nend\n"))
        self.assertIsNotNone(differs("a 1", "a 2"))
        self.assertIsNotNone(differs("a", "a\nb"))
        self.assertIsNotNone(differs("a\nb", "a"))

    def test_excerpts_keep_their_order(self):
        with tempfile.TemporaryDirectory(dir=ROOT / "tests") as folder:
            path = Path(folder) / "source"
            path.write_text("// one\n  two\nthree\nfour\n")
            self.assertIsNone(self.module.excerpt_differs("one\ntwo\n...\nfour", path))
            self.assertIsNotNone(self.module.excerpt_differs("one\nfour", path))
            self.assertIsNotNone(self.module.excerpt_differs("two\none", path))


class ClonePrograms(unittest.TestCase):
    """What stands in for a build in the documentation's clones does nothing, but does not take anything for good."""

    @classmethod
    def setUpClass(cls):
        sys.path.insert(0, str(ROOT / "scripts"))
        import docs_clone
        cls.temporary = tempfile.TemporaryDirectory()
        cls.root = Path(cls.temporary.name)
        cls.build, cls.clone = cls.root / "tested", cls.root / "clone"
        cls.clone.mkdir()
        (cls.clone / "CMakeLists.txt").write_text("cmake_minimum_required(VERSION 3.25)\nproject(p NONE)\nenable_testing()\n"
                                                   "add_custom_target(there COMMAND false)\nadd_test(NAME one COMMAND false)\n")
        (cls.clone / "CMakePresets.json").write_text('{"version": 5, "configurePresets": [{"name": "release", "generator": "Ninja", '
                                                      '"binaryDir": "${sourceDir}/build/release"}]}')
        subprocess.run(["cmake", "-G", "Ninja", "-S", str(cls.clone), "-B", str(cls.build)], check=True, stdout=subprocess.DEVNULL)
        docs_clone.clone_programs(cls.root / "programs", cls.build)
        cls.docs_clone = docs_clone

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def call(self, name, *arguments):
        done = subprocess.run([str(self.root / "programs" / name), *arguments], cwd=self.clone, text=True, capture_output=True, check=False)
        return done.returncode, done.stdout + done.stderr

    def test_a_preset_takes_the_tested_build(self):
        self.assertNotEqual(self.call("cmake", "--preset", "none")[0], 0)
        self.assertEqual(self.call("cmake", "--preset", "release")[0], 0)
        self.assertEqual((self.clone / "build/release").resolve(), self.build.resolve())

    def test_targets_are_looked_up_and_not_built(self):
        self.call("cmake", "--preset", "release")
        self.assertEqual(self.call("cmake", "--build", "build/release", "--parallel", "2", "--target", "there")[0], 0)
        self.assertEqual(self.call("cmake", "--build", "build/release", "--target", "there", "none"), (1, "no target none\n"))
        self.assertNotEqual(self.call("cmake", "--build", "build/none")[0], 0)

    def test_tests_are_listed(self):
        self.call("cmake", "--preset", "release")
        status, output = self.call("ctest", "--test-dir", "build/release", "-R", "one")
        self.assertEqual(status, 0)
        self.assertIn("one", output)
        self.assertNotEqual(self.call("ctest", "--test-dir", "build/release", "-R", "none")[0], 0)

    def test_a_test_program_lists(self):
        programs = self.root / "bin"
        programs.mkdir()
        self.docs_clone.write_program(programs / "test_a", '#!/bin/sh\necho "Suite."; echo "  Name"; [ "$2" = --gtest_list_tests ]\n')
        self.docs_clone.list_tests(self.root / "listed", programs)
        done = subprocess.run([str(self.root / "listed/test_a"), "--gtest_filter=*"], text=True, capture_output=True, check=True)
        self.assertEqual(done.stdout, "found Name\n")


class PublicHeaders(Tree):
    def test_a_header_that_needs_another(self):
        self.assertEqual(run("scripts/check_public_headers.py", "c++", self.root)[0], 0)
        self.write("include/abut/bad.hpp", "#pragma once\ninline std::vector<int> v;\n")
        status, output = run("scripts/check_public_headers.py", "c++", self.root)
        self.assertEqual(status, 1)
        self.assertIn("include/abut/bad.hpp does not compile alone", output)


if __name__ == "__main__":
    unittest.main()
