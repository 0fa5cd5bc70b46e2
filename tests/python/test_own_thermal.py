"""Thermal models written in Python: a decay and a single heat capacity against their closed forms, the built-in circuit written again against the built-in, and faults of the class come out.

A single capacity C that loses G (T - T_0) and starts at T_0 + D:  T = T_0 + D exp(-G t / C),  lost until t: C D (1 - exp(-G t / C)).
Without losses, whatever enters stays: T - T_0 = heat / C."""

import math
import sys
import threading
import traceback
import unittest

import numpy as np

sys.path.insert(0, __file__.rpartition("/")[0])
from package import SETTLING, PackageTest, rd  # noqa: E402


AMBIENT = 293.15  # of the case [K]
RING_CAPACITY = 0.21 * 510  # mass and specific heat of the case's inner rings, TB1 and TB2 [J/K]


class Lump(rd.ThermalModel):
    """Every bearing's inner ring takes all of its heat."""

    type = "python-lump"
    title = "a lump"
    parameters = {"cooling": rd.Quantity("W/K", 0.0), "warmer": rd.Quantity("1", 0.0, "rise at the start in kelvin")}

    def __init__(self, bearings, ambient, values):
        super().__init__(bearings, ambient, values)
        self.states = [rd.State(f"{bearing.name}/inner_ring", "K", 1.0) for bearing in bearings]
        self.capacity = np.array([bearing.ring_mass * bearing.ring.heat_capacity for bearing in bearings])

    def initial_state(self):
        return np.full(len(self.states), self.ambient + self.values["warmer"])

    def rates(self, temperature, heat):
        lost = self.values["cooling"] * (temperature - self.ambient)
        return (np.array([one.rub + one.inner + one.outer for one in heat]) - lost) / self.capacity, lost.sum()

    def growth(self, temperature):
        return [bearing.growth(inner_ring=T - self.ambient) for bearing, T in zip(self.bearings, temperature)]

    def stored_energy(self, temperature):
        return self.capacity @ (temperature - self.initial_state())


class Circuit(rd.ThermalModel):
    """The built-in circuit: shaft, inner ring, balls, outer ring, housing; temperatures of both contacts follow from their neighbours' and their heat."""

    type = "python-circuit"
    parts = ("shaft", "inner_ring", "ball", "outer_ring", "housing")

    def __init__(self, bearings, ambient, values):
        super().__init__(bearings, ambient, values)
        self.states = [rd.State(f"{bearing.name}/{part}", "K", 1.0) for bearing in bearings for part in self.parts]
        self.capacity = np.array([[bearing.capacities[part] for part in self.parts] for bearing in bearings])

    def rates(self, temperature, heat):
        rates, lost = [], 0.0
        for bearing, C, T, q in zip(self.bearings, self.capacity, temperature.reshape(-1, 5), heat):
            R, (s, i, b, o, h) = bearing.resistances, T
            R4, R5, R7 = R["R4"] + R["R4_spreading"], R["R5_inside"] + R["R5_constriction"], R["R7"] + R["R7_spreading"]
            inner_contact = (q.inner + i / R4 + b / R5) / (1 / R4 + 1 / R5)
            outer_contact = (q.outer + o / R7 + b / R5) / (1 / R7 + 1 / R5)
            between = (s - i) / (R["R2"] + R["R3"])
            to_housing = (o - h) / (R["R8_ring"] + R["R8_fit"] + R["R8_housing"])
            rise = max(h - self.ambient, 0.0)
            lost_by = ((s - self.ambient) / R["R1"], (b - self.ambient) / R["R6"], 23 * rise**1.25 * math.pi * bearing.housing_outside * bearing.housing_length)
            power = (
                q.rub - q.rub_into_ring - between - lost_by[0],
                q.rub_into_ring + between + (inner_contact - i) / R4,
                (inner_contact - b) / R5 + (outer_contact - b) / R5 - lost_by[1],
                (outer_contact - o) / R7 - to_housing,
                to_housing - lost_by[2],
            )
            rates.extend(power / C)
            lost += sum(lost_by)
        return rates, lost

    def growth(self, temperature):
        rises = temperature.reshape(-1, 5) - self.ambient
        return [bearing.growth(shaft=r[0], inner_ring=r[1], ball=r[2], outer_ring=r[3]) for bearing, r in zip(self.bearings, rises)]

    def stored_energy(self, temperature):
        return float((self.capacity * (temperature.reshape(-1, 5) - self.ambient)).sum())


class ThermalModels(PackageTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        rd.add_thermal_model(Lump)
        rd.add_thermal_model(Circuit)

    def case(self, models, end_time="12 ms", overrides=None):
        return rd.Case(SETTLING, {"run.end_time": end_time, "output.interval": "0.1 ms", "thermal.models": models, **(overrides or {})})

    def test_a_warm_lump_cools_by_the_exponential(self):
        # Before the first contact at 7 ms there is no heat.
        overrides = {"thermal.python-lump.cooling": "10000 W/K", "thermal.python-lump.warmer": 10.0, "integration.tolerance": 1e-9, "thermal.growth": False}
        result = self.case(["python-lump"], "5 ms", overrides).run()
        temperature = result["python-lump.TB1.inner_ring"]
        decay = np.exp(-1e4 * temperature.time.values / RING_CAPACITY)
        self.assertLess(decay[-1], 0.7)
        np.testing.assert_allclose(temperature.values, AMBIENT + 10 * decay, rtol=0, atol=1e-6)
        energy = result.summary["energy"]
        self.assertAlmostEqual(energy["python-lump_heat_lost"], 2 * RING_CAPACITY * 10 * (1 - decay[-1]), delta=1e-4)
        self.assertLess(abs(energy["python-lump_heat_residual"]), 1e-6 * energy["python-lump_heat_lost"])
        self.assertEqual(temperature.attrs["units"], "K")

    def test_a_lump_without_losses_keeps_all_heat(self):
        result = self.case(["lumped", "python-lump"]).run()
        energy = result.summary["energy"]
        self.assertGreater(energy["heat_deposited"], 10)
        rises = [result.summary["bearings"][name]["python-lump"]["temperature_rise_end"]["inner_ring"] for name in ("TB1", "TB2")]
        self.assertAlmostEqual(RING_CAPACITY * sum(rises), energy["heat_deposited"], delta=1e-6 * energy["heat_deposited"])
        self.assertLess(abs(energy["python-lump_heat_residual"]), 1e-6 * energy["heat_deposited"])
        self.assertEqual(energy["python-lump_heat_lost"], 0)

    def test_the_builtin_circuit_written_again_has_its_temperatures(self):
        result = self.case(["lumped", "python-circuit"], "20 ms", {"integration.tolerance": 1e-8}).run()
        for bearing in ("TB1", "TB2"):
            for part in Circuit.parts:
                builtin, again = (result[f"{group}.{bearing}.{part}"].values - AMBIENT for group in ("thermal", "python-circuit"))
                # The same equations on the same heat, in another order of operations.
                np.testing.assert_allclose(again, builtin, rtol=0, atol=1e-9 + 1e-7 * abs(builtin).max(), err_msg=f"{bearing}/{part}")
        self.assertGreater(result["thermal.TB1.inner_ring"].values[-1] - AMBIENT, 0.01)
        energy = result.summary["energy"]
        self.assertAlmostEqual(energy["python-circuit_heat_stored"], energy["heat_stored"], delta=1e-6 * energy["heat_stored"])

    def test_its_growth_is_fed_back_by_name(self):
        result = self.case(["lumped", "python-lump"], "15 ms", {"thermal.driver": "python-lump"}).run()
        felt, own, lumped = (result[path].values for path in ("bearings.TB1.expansion", "growth.python-lump.TB1", "growth.lumped.TB1"))
        np.testing.assert_allclose(felt, own, rtol=0, atol=1e-15)
        self.assertGreater(abs(own - lumped).max(), 1e-9)
        rise = result["python-lump.TB1.inner_ring"].values - AMBIENT
        self.assertGreater(rise[-1], 0.01)
        np.testing.assert_allclose(own[:, 1], 11.8e-6 * 0.035 * rise, rtol=1e-9, atol=1e-18)  # alpha r: the bore of a free ring
        np.testing.assert_array_equal(own[:, [0, 3, 4]], 0)  # shaft, outer race, balls
        energy = result.summary["energy"]
        self.assertLess(abs(energy["residual"]), 1e-6 * energy["dissipated"])

    def test_keys_are_checked_like_all_others(self):
        with self.assertRaises(rd.InputError) as caught:
            self.case(["python-lump"], overrides={"thermal.python-lump.coling": 1.0})
        (fault,) = caught.exception.faults
        self.assertIn("cooling", fault.message + fault.advice)
        with self.assertRaisesRegex(rd.InputError, "thermal.python-lump.cooling"):
            self.case(["python-lump"], overrides={"thermal.python-lump.cooling": "3 kg"})
        with self.assertRaisesRegex(rd.InputError, "python-lump"):
            self.case(["python-lum"])

    def test_exceptions_come_out_with_their_traceback(self):
        class Faulty(Lump):
            type = "python-faulty"

            def rates(self, temperature, heat):
                return self.deep_inside(heat[0].rub)

            def deep_inside(self, heat):
                raise ZeroDivisionError("in rates")

        rd.add_thermal_model(Faulty)
        try:
            self.case(["python-faulty"]).run()
            self.fail("nothing was raised")
        except ZeroDivisionError as error:  # assertRaises would drop the traceback
            self.assertIn("in rates", str(error))
            names = [frame.name for frame in traceback.extract_tb(error.__traceback__)]
        self.assertEqual(names[-2:], ["rates", "deep_inside"])

    def test_wrong_returns_are_explained(self):
        for name, methods, message in (
            ("python-pair", {"rates": lambda self, T, heat: [0.0, 0.0]}, r"python-pair\.rates\(\) must return a pair"),
            ("python-number", {"rates": lambda self, T, heat: ([0.0], 0.0)}, r"rates\(\) must return 2 numbers, and returned 1"),
            ("python-complex", {"rates": lambda self, T, heat: (1j * T, 0.0)}, r"rates\(\) must return 2 numbers, and returned array"),
            ("python-lost", {"rates": lambda self, T, heat: ([0.0, 0.0], "much")}, r"as the heat lost, must return a number, and returned 'much'"),
            ("python-grown", {"growth": lambda self, T: None}, r"growth\(\) must return an Expansion for each bearing, and returned None"),
            ("python-stored", {"stored_energy": lambda self, T: None}, r"stored_energy\(\) must return a number, and returned None"),
            ("python-text", {"rates": lambda self, T, heat: ("ab", 0.0)}, r"rates\(\) must return 2 numbers, and returned 'ab'"),
            ("python-start", {"initial_state": lambda self: [293.15]}, r"initial_state\(\) must return 2 numbers, and returned 1"),
            ("python-seen", {"observe": lambda self, T, heat: T[:1]}, r"observe\(\) must return 2 numbers, and returned 1"),
            ("python-places", {"growth": lambda self, T: [rd.Expansion()]}, r"Expansion for each of 2 bearings, and returned 1"),
            ("python-square", {"growth": lambda self, T: [rd.Expansion(bore=1e-9 * (one - self.ambient) ** 2) for one in T]}, r'must be linear.*"bore"'),
        ):
            with self.subTest(name), self.assertRaisesRegex(ValueError, message):
                rd.add_thermal_model(type("Wrong", (Lump,), {"type": name, **methods}))
                self.case([name]).run()

    def test_no_name_of_results_can_be_that_of_a_model(self):
        result = rd.Case(SETTLING, {"run.end_time": "1 ms"}).run(self.folder / "run")
        import h5py

        with h5py.File(self.folder / "run/results.h5") as file:
            names = set(file) | set(result.summary["bearings"]["TB1"])
        self.assertLessEqual({"parameters", "given", "peak_contact_force"}, names)
        for name in names:
            with self.subTest(name), self.assertRaisesRegex(ValueError, "the name is taken.*choose another of letters"):
                rd.add_thermal_model(type("Taken", (Lump,), {"type": name}))

    def test_names_that_are_taken_or_missing(self):
        for name in ("lumped", "energy", "none", "a b"):
            with self.subTest(name), self.assertRaises(ValueError):
                rd.add_thermal_model(type("Taken", (Lump,), {"type": name}))
        with self.assertRaisesRegex(ValueError, "needs a `type`"):
            rd.add_thermal_model(type("Nameless", (Lump,), {"type": ""}))
        with self.assertRaisesRegex(ValueError, "cannot change"):
            rd.add_thermal_model(type("Other", (Lump,), {"parameters": {}}))

    def test_a_class_can_be_replaced_by_one_with_the_same_keys(self):
        class Twice(Lump):
            def __init__(self, bearings, ambient, values):
                super().__init__(bearings, ambient, values)
                self.capacity *= 2

        self.addCleanup(rd.add_thermal_model, Lump)
        case = self.case(["lumped", "python-lump"])
        once = case.run().summary["bearings"]["TB1"]["python-lump"]["temperature_rise_end"]["inner_ring"]
        rd.add_thermal_model(Twice)
        self.assertAlmostEqual(case.run().summary["bearings"]["TB1"]["python-lump"]["temperature_rise_end"]["inner_ring"], once / 2, delta=1e-6 * once)

    def test_drops_in_threads_take_turns(self):
        case = self.case(["python-lump"], "9 ms")
        alone = case.run()["python-lump.TB2.inner_ring"].values
        found = [None] * 3

        def run(i):
            found[i] = case.run()["python-lump.TB2.inner_ring"].values

        threads = [threading.Thread(target=run, args=(i,)) for i in range(len(found))]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join(120)
        for one in found:
            np.testing.assert_array_equal(one, alone)


if __name__ == "__main__":
    unittest.main()
