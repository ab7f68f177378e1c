"""Reads exported trajectories with PedPy and compares what it finds with our own tables.

    python check.py FOLDER TABLES

FOLDER holds one folder for each exported run, with trajectories.csv (ours), trajectories.txt and trajectories.sqlite:
`whole`, the run of figure 11 at 8 frames a second, and `fps8`, `fps16`, ... , its beginning. TABLES is data/s17. Prints
a line for each comparison; ends with code 1 when one of them fails.
"""

import sys
from pathlib import Path

import numpy as np
import pandas as pd
import pedpy

# Text is written to nine digits behind the point; reading it back and a product may each be wrong in the last place.
HALF_DIGIT = 0.5e-9
ULP = np.finfo(float).eps
ALONG_X = np.array([1.0, 0.0])
failures = 0


def check(is_right, words):
    """Prints a comparison and counts it when it fails."""
    global failures
    failures += not is_right
    print(f"{'ok    ' if is_right else 'FAILED'}  {words}")


class Run:
    """A run as our table has it, in metres and seconds, and as PedPy reads it; all sorted by frame and pedestrian."""

    def __init__(self, folder):
        self.name = folder.name
        self.facts = header(folder / "trajectories.txt")
        self.a_0, self.tau, self.ring = (float(self.facts[key].split()[0]) for key in ("a_0", "tau", "ring_length"))
        self.rate = float(self.facts["framerate"])
        self.pedestrians = int(self.facts["pedestrians"])
        table = pd.read_csv(folder / "trajectories.csv")
        self.shape = (len(table) // self.pedestrians, self.pedestrians)
        self.x = self.a_0 * table.x.to_numpy().reshape(self.shape)
        self.v = self.a_0 / self.tau * table.v.to_numpy().reshape(self.shape)
        self.text = pedpy.load_trajectory(trajectory_file=folder / "trajectories.txt")
        self.sqlite = pedpy.load_trajectory_from_jupedsim_sqlite(trajectory_file=folder / "trajectories.sqlite")
        self.area = pedpy.load_walkable_area_from_jupedsim_sqlite(trajectory_file=folder / "trajectories.sqlite")

    def frame(self, t):
        """The frame at the time `t`, in units of tau."""
        return np.rint(np.asarray(t) * self.tau * self.rate).astype(int)

    def speeds(self):
        """PedPy's speeds of all but the first and the last frame."""
        found = pedpy.compute_individual_speed(
            traj_data=self.sqlite,
            frame_step=1,
            movement_direction=ALONG_X,
            speed_calculation=pedpy.SpeedCalculation.BORDER_EXCLUDE,
        ).sort_values(["frame", "id"])
        return found.speed.to_numpy().reshape(self.shape[0] - 2, self.pedestrians)


def header(file):
    """Names and values of the comments."""
    facts = {}
    with open(file, encoding="utf-8") as lines:
        for line in lines:
            if not line.startswith("#"):
                return facts
            name, _, value = line[1:].strip().partition(": ")
            facts[name] = value
    return facts


def grid(run, data, name):
    """A column as frames by pedestrians; None when a frame or a pedestrian is missing or doubled."""
    data = data.sort_values(["frame", "id"])
    frames, ids = np.divmod(np.arange(run.x.size), run.pedestrians)
    if len(data) != run.x.size or (data.frame.to_numpy() != frames).any() or (data.id.to_numpy() != ids).any():
        return None
    return data[name].to_numpy().reshape(run.shape)


def positions(run):
    """Both files hold all positions, as exactly as they can."""
    largest = np.abs(run.x).max()
    for name, found, allowed in [
        ("text", run.text, HALF_DIGIT + 2 * ULP * largest),
        ("sqlite", run.sqlite, 0.0),
    ]:
        x, y = grid(run, found.data, "x"), grid(run, found.data, "y")
        is_whole = x is not None
        error = np.abs(x - run.x).max() if is_whole else np.inf
        is_right = is_whole and error <= allowed and not y.any() and found.frame_rate == run.rate
        words = f"{run.shape[0]} frames of {run.pedestrians}, {found.frame_rate:g} a second"
        check(is_right, f"{run.name}: {name}: {words}; positions to {error:.2e} m (allowed {allowed:.2e})")
    inside = pedpy.is_trajectory_valid(traj_data=run.sqlite, walkable_area=run.area)
    check(inside, f"{run.name}: all positions in the walkable area, {run.area.bounds}")


def speed_errors(run):
    """PedPy's speeds minus ours, and what is left of it after the second difference of ours. A central difference is the
    mean of the speed over its window, by Simpson's rule the speed and a sixth of its second difference."""
    difference = run.speeds() - run.v[1:-1]
    return difference, difference - np.diff(run.v, 2, axis=0) / 6.0


def convergence(runs):
    """The difference of speeds is that of a central difference: it falls with the square of the time between frames,
    and with the fourth power once the second difference is taken off."""
    errors = []
    for run in runs:
        # at the times that all runs have, multiples of 1/8 s
        step = round(run.rate / 8)
        difference, rest = (values[step - 1 :: step] for values in speed_errors(run))
        errors.append((np.abs(difference).max(), np.abs(rest).max()))
        print(f"        {run.name}: speeds differ by at most {errors[-1][0]:.3e} m/s, corrected by {errors[-1][1]:.3e} m/s")
    orders = np.log2(np.array(errors[:-1]) / np.array(errors[1:]))
    for order, power, what in [(orders[:, 0], 2, "speeds"), (orders[:, 1], 4, "corrected speeds")]:
        # the next term of the error is smaller by the square of the time between frames: orders come closer by 4
        away = np.abs(order - power)
        is_right = (away[1:] < away[:-1] / 2).all() and away[-1] < 0.1
        check(is_right, f"{what}: orders {', '.join(f'{one:.3f}' for one in order)}, going to {power}")


def whole_run(run):
    """In the jams, too, the difference of speeds is that of a central difference: what the second difference leaves is the
    next term, a 180th of the fourth difference; twice that is allowed."""
    difference, rest = speed_errors(run)
    allowed = np.abs(np.diff(run.v, 4, axis=0)).max() / 90.0
    check(
        np.abs(rest).max() <= allowed,
        f"{run.name}: speeds differ by {rms(difference):.1e} m/s (rms), {np.abs(difference).max():.1e} at most; corrected"
        f" by {rms(rest):.1e}, {np.abs(rest).max():.1e} (allowed {allowed:.1e})",
    )
    return allowed


def with_images(run, frames):
    """The trajectories at these frames, and the pedestrian before the first and the one after the last: on the ring the
    first is ahead of the last by a circumference."""
    data = run.sqlite.data
    data = data.loc[data.frame.isin(frames), ["id", "frame", "x", "y"]]
    after = data[data.id == 0].assign(id=run.pedestrians, x=lambda rows: rows.x + run.ring)
    before = data[data.id == run.pedestrians - 1].assign(id=-1, x=lambda rows: rows.x - run.ring)
    return pedpy.TrajectoryData(data=pd.concat([data, after, before], ignore_index=True), frame_rate=run.rate)


def individual(run, states, steady, allowed_speed):
    """Headway, density and speed of every pedestrian, by the distance of Voronoi neighbours and by Voronoi cells."""
    frames = run.frame(states.t)
    ring = with_images(run, np.unique(frames))
    cells = pedpy.compute_individual_voronoi_polygons(traj_data=ring, walkable_area=run.area)
    pairs = pedpy.compute_neighbors(cells, as_list=False)
    is_next = (pairs.neighbor_id - pairs.id).abs() == 1
    check(bool(is_next.all()), f"neighbours of Voronoi cells: {len(pairs)} pairs, all next to each other in the row")
    distances = pedpy.compute_neighbor_distance(traj_data=ring, neighborhood=pairs)
    ahead = distances[(distances.neighbor_id == distances.id + 1) & (distances.id >= 0)].sort_values(["frame", "id"])
    if len(ahead) != len(states):
        check(False, f"{len(ahead)} pedestrians have a neighbour ahead, in place of {len(states)}")
        return
    ours = run.a_0 * states.headway.to_numpy()
    # two positions and a length of the ring, each rounded once, in our units and in metres
    allowed = 6 * ULP * np.abs(run.x).max()
    error = np.abs(ahead.distance.to_numpy() - ours).max()
    check(error <= allowed, f"headways of {len(ours)} states: to {error:.2e} m (allowed {allowed:.2e})")

    densities = cells[(cells.id >= 0) & (cells.id < run.pedestrians)].sort_values(["frame", "id"]).density.to_numpy()
    headways = ours.reshape(-1, run.pedestrians)
    expected = (2.0 / (headways + np.roll(headways, 1, axis=1))).ravel()
    error = np.abs(densities / expected - 1.0).max()
    # corners of cells are known to a few roundings of a coordinate, and a cell is no shorter than the least headway
    allowed = 16 * ULP * np.abs(run.x).max() / ours.min()
    check(error <= allowed, f"Voronoi densities are those of the mean of two headways: to {error:.2e} (allowed {allowed:.2e})")
    voronoi = densities - 1.0 / ours
    print(
        f"        Voronoi minus inverse headway: rms {rms(voronoi):.3f}, largest {np.abs(voronoi).max():.3f} 1/m,"
        f" of {(1.0 / ours).min():.3f} to {(1.0 / ours).max():.3f} 1/m"
    )

    ids = states.n.to_numpy().astype(int)
    difference, rest = (values[frames - 1, ids] for values in speed_errors(run))
    mine = run.a_0 / run.tau * states.speed.to_numpy()
    speeds = run.speeds()[frames - 1, ids]
    error = np.abs(speeds - mine - (difference - rest)).max()
    check(
        error <= allowed_speed,
        f"speeds of the states: differ by {rms(speeds - mine):.1e} m/s (rms), {np.abs(speeds - mine).max():.1e} at most;"
        f" corrected by {error:.1e} (allowed {allowed_speed:.1e})",
    )
    curve = (steady.density.to_numpy() / run.a_0, steady.speed.to_numpy() * run.a_0 / run.tau)
    away = [
        rms(speed - np.interp(density, *curve))
        for speed, density in [(mine, 1.0 / ours), (speeds, 1.0 / ahead.distance.to_numpy()), (speeds, densities)]
    ]
    print(
        f"        speeds from the uniform flow of the same density, rms: ours {away[0]:.4f} m/s, PedPy's {away[1]:.4f};"
        f" at the Voronoi density {away[2]:.4f}"
    )


def measured_area(run, first, allowed_speed):
    """Density and speed in a tenth of the ring, counted on positions that are wrapped around it."""
    frames = np.arange(run.frame(first), run.shape[0] - 1, round(run.rate))
    data = run.sqlite.data
    data = data.loc[data.frame.isin(frames), ["id", "frame", "x", "y"]].assign(x=lambda rows: rows.x % run.ring)
    # frames numbered without holes: PedPy puts a density of 0 into holes
    data = data.assign(frame=np.searchsorted(frames, data.frame.to_numpy()))
    wrapped = pedpy.TrajectoryData(data=data.reset_index(drop=True), frame_rate=1.0)
    length = 0.1 * run.ring
    area = pedpy.MeasurementArea([(0.0, -0.5), (length, -0.5), (length, 0.5), (0.0, 0.5)])
    density = pedpy.compute_classic_density(traj_data=wrapped, measurement_area=area).density.to_numpy()
    speeds = run.speeds()[frames - 1]
    individual_speed = wrapped.data.sort_values(["frame", "id"])[["id", "frame"]].assign(speed=speeds.ravel())
    speed = pedpy.compute_mean_speed_per_frame(
        traj_data=wrapped, individual_speed=individual_speed, measurement_area=area
    ).speed.to_numpy()

    places = run.x[frames] % run.ring
    is_inside = (places > 0.0) & (places < length)
    counts = is_inside.sum(axis=1)
    error = np.abs(density - counts / length).max()
    check(error <= 4 * ULP * density.max(), f"classic density in {length:g} m, {len(frames)} frames: to {error:.1e} 1/m")
    corrected = (run.v[1:-1] + np.diff(run.v, 2, axis=0) / 6.0)[frames - 1]
    ours = np.where(is_inside, corrected, 0.0).sum(axis=1) / counts
    error = np.abs(speed - ours).max()
    check(error <= allowed_speed, f"mean speed there, ours corrected: to {error:.1e} m/s (allowed {allowed_speed:.1e})")
    flow, flow_everywhere = (density * speed).mean(), run.v[frames].mean() * run.pedestrians / run.ring
    print(
        f"        means over these frames: density {density.mean():.4f} 1/m (of the ring {run.pedestrians / run.ring:.4f}),"
        f" flow {flow:.4f} 1/s (of the ring {flow_everywhere:.4f})"
    )


def rms(values):
    return float(np.sqrt(np.mean(np.square(values))))


def main(folder, tables):
    runs = sorted((Run(one) for one in folder.glob("fps*")), key=lambda run: run.rate)
    for run in runs:
        positions(run)
    convergence(runs)
    whole = Run(folder / "whole")
    positions(whole)
    allowed = whole_run(whole)
    states = pd.read_csv(tables / "states.csv")
    # the last frame has no central difference
    states = states[whole.frame(states.t) < whole.shape[0] - 1]
    individual(whole, states, pd.read_csv(tables / "steady.csv"), allowed)
    measured_area(whole, states.t.min(), allowed)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]), Path(sys.argv[2])))
