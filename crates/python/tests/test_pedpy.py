"""PedPy takes the trajectories: speeds, headways, densities, a fundamental diagram."""

import numpy as np
import pytest
from conftest import ROOT, SHORT

import jamming

pedpy = pytest.importorskip("pedpy")

TAU, A0 = 0.5, 0.4
# text and products are rounded; lengths of the ring are added
ROUNDINGS = 16 * np.finfo(float).eps


@pytest.fixture(scope="module")
def run():
    """Fifty pedestrians in stop-and-go waves, 16 frames a second."""
    return jamming.simulate(ROOT / "scenes/ring.toml", check=False, **{"run.t_end": 200.0, "run.sample": 0.125})


def grid(run, data, name):
    """A column as frames by pedestrians."""
    return data.sort_values(["frame", "id"])[name].to_numpy().reshape(-1, run.pedestrians)


def test_positions_are_ours_in_metres(run):
    found = run.to_pedpy(a0=A0, tau=TAU)
    assert found.frame_rate == 1 / (0.125 * TAU)
    assert (grid(run, found.data, "x") == A0 * run.x).all()
    assert pedpy.is_trajectory_valid(traj_data=found, walkable_area=run.walkable_area(a0=A0, tau=TAU))


def test_speeds_are_ours_up_to_the_central_difference(run):
    found = pedpy.compute_individual_speed(
        traj_data=run.to_pedpy(a0=A0, tau=TAU),
        frame_step=1,
        movement_direction=np.array([1.0, 0.0]),
        speed_calculation=pedpy.SpeedCalculation.BORDER_EXCLUDE,
    )
    speeds, ours = grid(run, found, "speed"), A0 / TAU * run.v
    # a central difference is the mean of the speed over its window; by Simpson's rule the speed and a sixth of its second
    # difference, and the next term is a 180th of the fourth
    rest = np.abs(speeds - ours[1:-1] - np.diff(ours, 2, axis=0) / 6).max()
    assert rest <= np.abs(np.diff(ours, 4, axis=0)).max() / 90
    assert np.abs(speeds - ours[1:-1]).max() > 10 * rest


def test_densities_are_those_of_the_headways(run):
    """Voronoi cells in a corridor 1 m wide end half-way to both neighbours."""
    ring = run.to_pedpy(a0=A0, tau=TAU, images=1)
    frames = [800, 1600]
    few = pedpy.TrajectoryData(data=ring.data[ring.data.frame.isin(frames)], frame_rate=ring.frame_rate)
    area = run.walkable_area(a0=A0, tau=TAU)
    cells = pedpy.compute_individual_voronoi_polygons(traj_data=few, walkable_area=area)
    cells = cells[(cells.id >= 0) & (cells.id < run.pedestrians)]
    x = A0 * run.x[frames]
    headways = np.diff(np.hstack([x, x[:, :1] + A0 * run.length]), axis=1)
    expected = 2.0 / (headways + np.roll(headways, 1, axis=1))
    error = np.abs(grid(run, cells, "density") / expected - 1).max()
    assert error <= ROUNDINGS * np.abs(x).max() / headways.min()


def test_a_fundamental_diagram(run):
    """PedPy's density and speed of each pedestrian: dense where slow."""
    ring = run.to_pedpy(a0=A0, tau=TAU, images=1)
    late = ring.data[(ring.data.frame >= 1500) & (ring.data.frame % 20 == 0)]
    few = pedpy.TrajectoryData(data=late, frame_rate=ring.frame_rate)
    cells = pedpy.compute_individual_voronoi_polygons(traj_data=few, walkable_area=run.walkable_area(a0=A0, tau=TAU))
    speeds = pedpy.compute_individual_speed(
        traj_data=ring, frame_step=1, movement_direction=np.array([1.0, 0.0]), speed_calculation=pedpy.SpeedCalculation.BORDER_EXCLUDE
    )
    both = cells.merge(speeds, on=["id", "frame"])
    both = both[(both.id >= 0) & (both.id < run.pedestrians)]
    assert len(both) == 50 * len(both.frame.unique())
    assert np.corrcoef(both.density, both.speed)[0, 1] < -0.5
    # the mean density of cells that fill the ring, each weighed by its length, is that of the ring
    mean = len(both) / (1.0 / both.density).sum()
    assert abs(mean / (run.pedestrians / (A0 * run.length)) - 1) < 1e-9


def test_units():
    run = jamming.simulate(SHORT, check=False)
    # v_0' = 1.2, so that 1.2 m/s is a_0 = tau
    assert run.to_pedpy().data.x.max() == 0.5 * run.x.max()
    assert run.to_pedpy(tau=0.25).frame_rate == 4.0
    for wrong in ({"a0": 0.0}, {"tau": float("inf")}, {"a0": float("nan")}, {"images": -1}):
        with pytest.raises(ValueError, match="must be"):
            run.to_pedpy(**wrong)
    with pytest.raises(ValueError, match="trajectories"):
        jamming.simulate(SHORT, **{"run.record": "std"}).to_pedpy()
