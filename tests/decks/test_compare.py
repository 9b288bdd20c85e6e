#!/usr/bin/env python3
"""Tests of compare.py and run_deck.py on histories whose answer is known."""
import math
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
import compare
import run_deck


def history(**columns):
    n = len(next(iter(columns.values())))
    return compare.History([0.1 * k for k in range(n)], {name.replace("__", "/"): list(v) for name, v in columns.items()})


def only(result, reference, noise=None, tolerance=0.01, patterns=("*",)):
    return {c.signal: c for c in compare.compare(result, reference, noise or {}, tolerance, patterns)}


class Deviation(unittest.TestCase):
    def test_a_constant_factor_is_the_deviation(self):
        reference = history(GLOBAL__IE=[0, 1, 2, 3])
        result = history(GLOBAL__IE=[0, 1.02, 2.04, 3.06])
        c = only(result, reference)["GLOBAL/IE"]
        self.assertAlmostEqual(c.deviation, 0.02, places=12)
        self.assertEqual(c.status, "fail")
        self.assertEqual(only(result, reference, tolerance=0.021)["GLOBAL/IE"].status, "pass")

    def test_noise_widens_and_too_much_of_it_excludes(self):
        reference, result = history(GLOBAL__IE=[1, 1]), history(GLOBAL__IE=[1.1, 1.1])
        self.assertEqual(only(result, reference, {"GLOBAL/IE": 0.06})["GLOBAL/IE"].status, "fail")
        self.assertEqual(only(result, reference, {"GLOBAL/IE": 0.07})["GLOBAL/IE"].status, "pass")
        self.assertEqual(only(result, reference, {"GLOBAL/IE": 0.21})["GLOBAL/IE"].status, "not comparable")

    def test_a_signal_of_rounding_does_not_decide(self):
        reference = history(NODE__1__DX=[0, 1e-12], NODE__2__DZ=[0, 1.0])
        result = history(NODE__1__DX=[0, 2e-12], NODE__2__DZ=[0, 1.0])
        self.assertLess(only(result, reference)["NODE/1/DX"].deviation, 1e-8)

    def test_groups(self):
        self.assertEqual(compare.group_of("NODE/7/DX"), compare.group_of("NODE/8/DZ"))
        self.assertNotEqual(compare.group_of("NODE/7/DX"), compare.group_of("NODE/7/VX"))
        self.assertEqual(compare.group_of("INTER/1/IFNX"), compare.group_of("INTER/2/IFNZ"))
        self.assertNotEqual(compare.group_of("INTER/1/IFNX"), compare.group_of("INTER/1/IFTX"))
        self.assertEqual(compare.group_of("GLOBAL/IE"), compare.group_of("GLOBAL/EXTW"))
        self.assertEqual(compare.group_of("PART/1/IE"), compare.group_of("PART/2/IE"))
        self.assertNotEqual(compare.group_of("PART/1/IE"), compare.group_of("PART/1/KE"))

    def test_a_missing_signal_is_said(self):
        self.assertEqual(only(history(GLOBAL__KE=[1, 1]), history(GLOBAL__IE=[1, 1]))["GLOBAL/IE"].status, "missing")

    def test_nan_fails(self):
        self.assertEqual(only(history(GLOBAL__IE=[1, math.nan]), history(GLOBAL__IE=[1, 1]))["GLOBAL/IE"].status, "fail")

    def test_interpolation_is_exact_for_lines(self):
        reference = compare.History([0.0, 0.25, 0.5, 1.0], {"GLOBAL/IE": [0.0, 0.25, 0.5, 1.0]})
        result = compare.History([0.0, 0.3, 0.7, 1.0], {"GLOBAL/IE": [0.0, 0.3, 0.7, 1.0]})
        self.assertLess(only(result, reference)["GLOBAL/IE"].deviation, 1e-15)

    def test_a_short_result_is_not_complete(self):
        self.assertFalse(compare.covers(compare.History([0.0, 0.5], {}), compare.History([0.0, 1.0], {})))
        self.assertTrue(compare.covers(compare.History([0.0, 0.99], {}), compare.History([0.0, 1.0], {})))

    def test_default_signals(self):
        reference = history(GLOBAL__IE=[1, 1], GLOBAL__DT=[1, 1], GLOBAL__XMOM=[1, 1], PART__1__KE=[1, 1], PART__1__HE=[1, 1],
                            INTER__1__IFNX=[1, 1], NODE__5__VX=[1, 1], RWALL__1__IFNX=[1, 1])
        self.assertEqual(set(only(reference, reference, patterns=compare.SIGNALS)),
                         {"GLOBAL/IE", "GLOBAL/XMOM", "PART/1/KE", "INTER/1/IFNX", "NODE/5/VX"})


class Energy(unittest.TestCase):
    def verdict(self, **columns):
        return {what: good for what, _, _, _, good in run_deck.energy(history(**columns))}

    def test_limits_depend_on_contact(self):
        columns = dict(GLOBAL__LEDGER=[0, 0.001, 0.001], GLOBAL__ERR=[0, -0.015, 0.005], INTER__1__NC=[0, 4, 0])
        self.assertTrue(all(self.verdict(**columns).values()))
        columns["INTER__1__NC"] = [0, 0, 4]
        self.assertFalse(self.verdict(**columns)["ERR outside contact"])

    def test_ledger_and_nan(self):
        self.assertFalse(self.verdict(GLOBAL__LEDGER=[0, -0.0021], GLOBAL__ERR=[0, 0])["LEDGER"])
        self.assertFalse(self.verdict(GLOBAL__LEDGER=[0, math.nan], GLOBAL__ERR=[0, 0])["LEDGER"])

    def test_a_missing_column_is_an_error(self):
        with self.assertRaises(RuntimeError):
            self.verdict(GLOBAL__ERR=[0, 0])


if __name__ == "__main__":
    unittest.main()
