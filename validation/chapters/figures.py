"""The paper's figures 9 to 19 from our runs: same panels, axes and units. Curves are this program's; marks are what the paper says, from paper-figures.toml."""

import base64
import io

import h5py
import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (the backend must be chosen first)

# Okabe & Ito, told apart by everyone; dashes tell them apart in print.
BLUE, RED, GREEN, PURPLE, ORANGE, SKY, BLACK = "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#333333"
TABLE4 = {"ideal": ("ideal", BLACK, "-"), "order1-1um": ("1st, 1 µm", BLUE, "-"), "order2-1um": ("2nd, 1 µm", RED, "-"), "order3-1um": ("3rd, 1 µm", GREEN, "-"), "order2-4um": ("2nd, 4 µm", ORANGE, "--"), "order3-2um": ("3rd, 2 µm", PURPLE, "--")}
ONE_MICROMETRE = list(TABLE4)[:4]
STYLE = {"font.size": 8.5, "axes.titlesize": 9, "axes.titlelocation": "left", "axes.spines.top": False, "axes.spines.right": False, "axes.grid": True, "grid.color": "#e6e6e6", "grid.linewidth": 0.6,
         "axes.axisbelow": True, "lines.linewidth": 0.9, "legend.frameon": False, "legend.fontsize": 7.5, "figure.constrained_layout.use": True, "agg.path.chunksize": 20000}
GAP = 250


class Series:
    """Series of the runs that were kept, by condition."""

    def __init__(self, folders):
        self.folders = folders
        self.claims = {}  # of the paper, by id

    def get(self, condition, *names):
        with h5py.File(self.folders[condition] / "run" / "results.h5", "r") as file:
            return [file[name][:] for name in names]


def picture(figure):
    """A PNG as text for an <img>."""
    data = io.BytesIO()
    figure.savefig(data, format="png", dpi=115)
    plt.close(figure)
    return "data:image/png;base64," + base64.b64encode(data.getvalue()).decode()


def panels(rows=1, columns=1, height=2.6, width=7.6, **options):
    return plt.subplots(rows, columns, figsize=(width, height * rows), squeeze=False, **options)


def legend_above(axes, columns=6):
    axes.legend(loc="lower right", bbox_to_anchor=(1, 1), ncol=columns, borderaxespad=0.2, handlelength=1.6, columnspacing=1.0)


def mark(axis, series, claim, x=None, scale=1.0, offset=0.0, text="", side=1, y=None):
    """The paper's number as a diamond with the claim's band as a bar; a bound as a triangle. `x`: where the paper does not say where it stands. `y`: of a number that is a time."""
    c = series.claims[claim]
    x = c.at if c.at is not None else x
    value, style = scale * (c.paper + offset), dict(color=BLACK, marker="D", markersize=4, linestyle="", zorder=5, clip_on=False)
    if c.bound:
        axis.plot([x], [value], **{**style, "marker": "^" if c.bound == "above" else "v", "markersize": 7})
    elif y is not None:
        x, value = c.paper, y
        axis.errorbar([x], [value], xerr=[x * c.width], capsize=3, elinewidth=0.9, **style)
    else:
        axis.errorbar([x], [value], yerr=[scale * abs(c.paper) * c.width], capsize=3, elinewidth=0.9, **style)
    if text:
        axis.annotate(text, (x, value), xytext=(7 * side, -11 if y is not None else 4), textcoords="offset points", ha="left" if side > 0 else "right", color="#555555", fontsize=7.5)


def figure_9(series):
    figure, axes = panels(1, 3, height=2.9)
    circle = np.linspace(0, 2 * np.pi, 200)
    for axis, condition, letter, mu in zip(axes[0], ("friction-005", "ideal", "friction-015"), "abc", (0.05, 0.10, 0.15)):
        orbit, = series.get(condition, "/bearings/TB2/orbit")
        axis.plot(GAP * np.cos(circle), GAP * np.sin(circle), color="#888888", linestyle=(0, (5, 3)))
        axis.plot(1e6 * orbit[:, 1], 1e6 * orbit[:, 0], color=BLUE, linewidth=0.7)
        axis.set(title=f"{letter}) friction {mu:.2f}", xlabel="z [µm]", aspect="equal", xlim=(-310, 310), ylim=(-310, 310), xticks=(-250, 0, 250), yticks=(-250, -150, 0, 250))
    mark(axes[0][0], series, "9.apex", x=0.0, text="paper")
    axes[0][0].set_ylabel("y [µm]")
    return figure


def both_bearings(axis, series, name, scale, column=None):
    time, = series.get("ideal", "/time")
    for bearing, colour, dashes in (("TB1", BLUE, "-"), ("TB2", RED, "--")):
        values, = series.get("ideal", f"/bearings/{bearing}/{name}")
        axis.plot(time, scale * (values if column is None else values[:, column]), color=colour, linestyle=dashes, label=bearing)
    axis.set_xlim(0, 0.3)


def figure_10(series):
    figure, axes = panels(2, 1, height=2.1, sharex=True)
    for row, (axis, letter, label) in enumerate(zip(axes[:, 0], "ab", "yz")):
        both_bearings(axis, series, "orbit", 1e6, row)
        axis.axhline(-GAP, color="#888888", linestyle=(0, (5, 3)), linewidth=0.9)
        axis.set(title=f"{letter}) {label}-direction", ylabel=f"{label} [µm]", ylim=(-330, 60) if row == 0 else (-270, 270))
    axes[1][0].axhline(GAP, color="#888888", linestyle=(0, (5, 3)), linewidth=0.9)
    axes[1][0].plot([series.claims["10.zero"].at], [0], color=BLACK, marker="D", markersize=4, clip_on=False, zorder=5)
    axes[1][0].annotate("paper", (0.3, 0), xytext=(-7, 4), textcoords="offset points", ha="right", color="#555555", fontsize=7.5)
    axes[1][0].set_xlabel("time [s]")
    legend_above(axes[0][0])
    return figure


def figure_11(series):
    figure, ((axis,),) = panels()
    both_bearings(axis, series, "ring_speed", 1)
    time, speed = series.get("ideal", "/time", "/rotor/spin_speed")
    axis.plot(time, speed, color=BLACK, label="rotor")
    mark(axis, series, "11.catch-up", y=float(speed[0]), text="paper: TB1 at rotor speed", side=-1)
    axis.set(xlabel="time [s]", ylabel="angular velocity [rad/s]", ylim=(0, 1700))
    legend_above(axis)
    return figure


def waves(axis, series, name, scale=1.0, conditions=ONE_MICROMETRE, bearing="TB2", offset=0.0, rise=False, of=None):
    for condition in conditions:
        time, values = series.get(condition, "/time", name if name.startswith("/") else f"/bearings/{bearing}/{name}")
        values = of(values) if of else values
        label, colour, dashes = TABLE4[condition]
        axis.plot(time, scale * (values - (values[0] if rise else 0.0) - offset), color=colour, linestyle=dashes, label=label, linewidth=0.8, zorder=3 if condition == "ideal" else 2)
    axis.set_xlim(0, 0.3)


def figure_12(series):
    figure, axes = panels(3, 1, height=2.1)
    for axis, limits, title in zip(axes[:, 0], ((0, 0.3), (0.025, 0.1), (0.16, 0.24)), ("a) 0 to 0.3 s", "b) 0.025 to 0.1 s", "0.16 to 0.24 s (not in the paper, which gives no time for its 150 and 1000 N)")):
        waves(axis, series, "contact_force")
        axis.set(title=title, ylabel="contact force [N]", xlim=limits)
    axes[0][0].set_ylim(0, 5600)
    mark(axes[0][0], series, "12.first-peak", x=0.009, text="paper: exceeds 5000 N")
    mark(axes[0][0], series, "12.settled", text="paper")
    for claim in ("12.order3-low", "12.order3-high"):
        mark(axes[2][0], series, claim, text="paper, 3rd")
    axes[2][0].set_ylim(0, 1600)
    axes[1][0].set_ylim(0, 3000)
    axes[2][0].set_xlabel("time [s]")
    legend_above(axes[0][0])
    return figure


def figure_13(series):
    figure, axes = panels(2, 1, height=2.1)
    for axis, limits, title in zip(axes[:, 0], ((0, 0.3), (0.16, 0.24)), ("0 to 0.3 s", "0.16 to 0.24 s, detail")):
        waves(axis, series, "bearing_force", of=lambda v: np.hypot(*v.T))
        axis.set(title=title, ylabel="bearing force [N]", xlim=limits)
    axes[0][0].set_ylim(0, 5600)
    axes[1][0].set(xlabel="time [s]", ylim=(0, 1600))
    legend_above(axes[0][0])
    return figure


def figure_14(series):
    figure, axes = panels(2, 1, height=2.2, sharex=True)
    time, load, drag = series.get("ideal", "/time", "/bearings/TB2/load_torque", "/bearings/TB2/drag_torque")
    axis = axes[0][0]
    for values, label, colour, dashes in ((load, "load-dependent", BLUE, "-"), (drag, "velocity-dependent", RED, "--"), (load + drag, "global", BLACK, ":")):
        axis.plot(time, values, label=label, color=colour, linestyle=dashes)
    axis.set(title="a) ideal surface", ylabel="torque [N m]")
    mark(axis, series, "14.load", text="paper, load-dependent")
    legend_above(axis)
    for condition in ONE_MICROMETRE:
        load, drag = series.get(condition, "/bearings/TB2/load_torque", "/bearings/TB2/drag_torque")
        label, colour, dashes = TABLE4[condition]
        axes[1][0].plot(time, load + drag, label=label, color=colour, linestyle=dashes, linewidth=0.8)
    axes[1][0].set(title="b) global, table 4", ylabel="torque [N m]", xlabel="time [s]", xlim=(0, 0.3))
    legend_above(axes[1][0])
    return figure


def figure_15(series):
    figure, axes = panels(1, 2, height=2.5)
    for axis, bearing, colour in zip(axes[0], ("TB1", "TB2"), (BLUE, RED)):
        time, torque = series.get("ideal", "/time", f"/bearings/{bearing}/spin_torque")
        axis.plot(time, 1e3 * torque, color=colour)
        axis.set(title=bearing, xlabel="time [s]", ylabel="spin torque [N mm]", xlim=(0, 0.3))
    return figure


def figure_16(series):
    figure, axes = panels(2, 1, height=2.2, sharex=True)
    for axis, race, letter in zip(axes[:, 0], ("inner", "outer"), "ab"):
        waves(axis, series, f"{race}_heat_rate")
        mark(axis, series, f"16.{race}", text="paper, ideal")
        axis.set(title=f"{letter}) {race} ring", ylabel="heat rate [W]")
    axes[1][0].set_xlabel("time [s]")
    legend_above(axes[0][0], 4)
    return figure


def figure_17(series):
    figure, axes = panels(2, 1, height=2.1)
    for axis, limits, title in zip(axes[:, 0], ((0, 0.3), (0, 0.03)), ("0 to 0.3 s", "first contacts")):
        waves(axis, series, "rub_heat_rate", 1e-3)
        axis.set(ylabel="rub heat rate [kW]", xlim=limits, title=title)
        mark(axis, series, "17.peak", scale=1e-3, text="paper, ideal")
    axes[1][0].set_xlabel("time [s]")
    legend_above(axes[0][0], 4)
    return figure


NODES = {"inner_contact": ("T_ci", ORANGE, "-"), "inner_ring": ("T_i", RED, "-"), "outer_contact": ("T_co", SKY, "-"), "shaft": ("T_s", BLACK, "--"), "outer_ring": ("T_o", BLUE, "--"), "ball": ("T_b", GREEN, "-"), "housing": ("T_h", PURPLE, ":")}
HOUSING_18 = 293.0  # K; the claims are rises above the housing, which stays there
PAPER_18 = {"inner_ring": "18.inner-ring", "ball": "18.ball", "outer_ring": "18.outer-ring"}


def figure_18(series):
    figure, axes = panels(1, 2, height=3.4, sharey=True)
    for axis, bearing in zip(axes[0], ("TB1", "TB2")):
        time, = series.get("ideal", "/time")
        for node, (label, colour, dashes) in NODES.items():
            values, = series.get("ideal", f"/thermal/{bearing}/{node}")
            axis.plot(time, values, color=colour, linestyle=dashes, label=label)
            if node in PAPER_18:
                claim = series.claims[PAPER_18[node]]
                axis.errorbar([claim.at], [HOUSING_18 + claim.paper], yerr=[claim.paper * claim.width], marker="D", markersize=4, capsize=3, elinewidth=0.9, color=colour, clip_on=False, linestyle="")
        axis.set(title=f"{bearing} (diamonds: the paper at 0.3 s)", xlabel="time [s]", xlim=(0, 0.3))
    axes[0][0].set_ylabel("temperature [K]")
    axes[0][0].legend(loc="upper left")
    return figure


def figure_19(series):
    figure, axes = panels(1, 2, height=3.2, sharey=True)
    for axis, node, title in zip(axes[0], ("inner_ring", "inner_contact"), ("a) inner ring", "b) contact of ball and inner ring")):
        waves(axis, series, f"/thermal/TB2/{node}", conditions=list(TABLE4), rise=True)
        axis.set(title=title, xlabel="time [s]", ylim=(0, 9.4))
    for claim, offset, label in (("19.four-um", 0.0, "paper, 2nd, 4 µm"), ("19.ideal", 0.0, "paper, ideal"), ("19.one-um", series.claims["19.ideal"].paper, "paper, 1 µm")):
        mark(axes[0][0], series, claim, offset=offset, text=label, side=-1)
    axes[0][0].set_ylabel("temperature rise [K]")
    axes[0][1].legend(loc="upper left")
    return figure


FIGURES = {
    "9": (figure_9, "Orbit of the rotor at TB2 for three friction coefficients; dashed: the air gap"),
    "10": (figure_10, "Displacement of the rotor at the touchdown bearings; dashed: the air gap"),
    "11": (figure_11, "Angular velocity of the rotor and of the inner rings"),
    "12": (figure_12, "Contact force between rotor and inner ring, TB2"),
    "13": (figure_13, "Magnitude of the bearing force, TB2"),
    "14": (figure_14, "Friction torque in the bearing, TB2"),
    "15": (figure_15, "Spin torque of the most loaded ball on the inner race, ideal surface"),
    "16": (figure_16, "Bearing friction heat rate, TB2"),
    "17": (figure_17, "Rub heat rate between rotor and ring, TB2"),
    "18": (figure_18, "Temperatures of the nodes of the circuit, ideal surface"),
    "19": (figure_19, "Temperature rise of inner ring and inner contact, table 4, TB2"),
}


def draw(series, claims, wanted=None):
    """{figure: (caption, picture)}; `claims` of the paper by id, for the marks."""
    series.claims = claims
    with plt.rc_context(STYLE):
        return {name: (caption, picture(function(series))) for name, (function, caption) in FIGURES.items() if wanted is None or name in wanted}
