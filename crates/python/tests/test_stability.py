"""Stability of one flow, against formulas and against the command line."""

import numpy as np
import pytest
from conftest import ROOT, SHORT

import jamming

RING = ROOT / "scenes/ring.toml"


def test_it_is_that_of_a_run():
    run = jamming.simulate(SHORT)
    flow = jamming.stability(SHORT, run.length / run.pedestrians)
    told, ring = run.summary["uniform_flow"], flow.on_ring(run.pedestrians)
    assert (flow.speed, flow.margin, flow.stable) == (run.summary["steady_speed"], told["margin"], told["stable"])
    assert list(flow.growing) == told["growing_k"]
    assert (ring.margin, ring.growth_rate, ring.waves) == (told["margin_on_ring"], told["growth_rate"], told["waves"])
    assert flow.margin_error < 1e-12


@pytest.mark.parametrize("law", [RING, RING.read_text(encoding="utf-8"), {"kind": "logarithmic", "v0": 1.2, "a_v": 0.05, "epsilon": 0.01}])
def test_a_law_in_any_form(law):
    flow = jamming.stability(law, 1.5)
    assert (flow.stable, flow.speed) == (False, jamming.stability(RING, 1.5).speed)
    assert jamming.stability(law, 1.5, **{"law.v0": 0.3}).speed < flow.speed


def test_growth_rates_solve_the_equation_of_waves():
    """The optimal velocity model: z^2 + kappa z + kappa V' (1 - e^{ik}) = 0."""
    kappa, headway = 0.8, 1.7
    law = {"kind": "formula", "acceleration": "kappa*(V - v)", "V": "tanh(s - 2) + tanh(2)", "kappa": kappa, "body": 0}
    slope = 1 / np.cosh(headway - 2) ** 2
    k = np.linspace(0.01, np.pi, 50).reshape(5, 10)
    roots = (-kappa + np.sqrt(kappa**2 - 4 * kappa * slope * (1 - np.exp(1j * k)))) / 2
    flow = jamming.stability(law, headway)
    assert np.abs(flow.growth_rate(k) - roots.real).max() < 1e-14
    assert flow.growth_rate_error(k).max() < 1e-15
    assert flow.stable == (kappa > 2 * slope)
    for wrong in (0.0, 4.0, np.nan):
        with pytest.raises(ValueError, match="pi"):
            flow.growth_rate(wrong)
    with pytest.raises(ValueError, match="at least 2"):
        flow.on_ring(1)


def test_a_kink_has_no_margin():
    law = {"kind": "formula", "acceleration": "min(s - 1, 1) - v", "body": 0}
    flow = jamming.stability(law, 2.0)
    assert (flow.speed, flow.stable, flow.margin, flow.on_ring(10)) == (1.0, None, None, None)
    assert np.isnan(flow.growth_rate([1.0])).all()


def test_one_of_several_speeds():
    law = {"kind": "formula", "acceleration": "(v - 1)*(v - 2)*(3 - v)", "body": 0, "scale": 1}
    with pytest.raises(jamming.SceneError, match="several"):
        jamming.stability(law, 2.0)
    assert jamming.stability(law, 2.0, speed=2.8).speed == pytest.approx(3.0, abs=1e-12)
