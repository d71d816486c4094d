"""Recordings of a joint whose servo is known, made without the model that is fitted."""

from __future__ import annotations

import numpy as np

from rgss.identification import CommandedPositions, JointSeries, Recording, Segment
from rgss.scenes import ServoControl

NOISE_RAD, NOISE_RAD_S = 0.0005, 0.01


def euler_motion(servo, times_s, commanded_rad, commanded_rad_s, *, finer=100, is_interpolated=False):
    """Motion by explicit Euler in small steps, with a command that is looked up at the delayed time."""
    step_s = (times_s[1] - times_s[0]) / finer
    q = v = 0.0
    positions, velocities = [], []
    for sample in range(len(times_s)):
        positions.append(q)
        velocities.append(v)
        for piece in range(finer):
            late_s = times_s[sample] + (piece + 0.5) * step_s - servo.delay_s
            at = max(0, min(len(times_s) - 1, int(np.floor((late_s - times_s[0]) / (times_s[1] - times_s[0])))))
            target = float(np.interp(late_s, times_s, commanded_rad)) if is_interpolated else commanded_rad[at]
            pushed = servo.position_gain_hz2 * (target - q)
            pushed += servo.velocity_gain_hz * (commanded_rad_s[at] - v) - servo.viscous_hz * v
            free = v + step_s * pushed
            friction = step_s * servo.coulomb_rad_s2
            v = 0.0 if abs(free) <= friction else free - friction * (1 if free > 0 else -1)
            q += step_s * v
    return np.array(positions), np.array(velocities)


def course_of(speed_rad_s, *, rate_hz=200, rest_s=0.1, hold_s=0.4):
    """Times, positions and speeds of a step forwards and backwards."""
    rest, hold = np.zeros(round(rest_s * rate_hz)), np.full(round(hold_s * rate_hz), speed_rad_s)
    velocities = np.concatenate([rest, hold, -hold, rest])
    positions = np.concatenate([[0.0], np.cumsum(velocities[:-1])]) / rate_hz
    return np.arange(len(velocities)) / rate_hz, positions, velocities


def recording_of(
    motions,
    *,
    control=ServoControl.VELOCITY,
    commands=CommandedPositions.HELD,
    seed=0,
    noise=(NOISE_RAD, NOISE_RAD_S),
    joint="j1",
):
    """A recording from (times, commanded positions and speeds, positions, speeds) of each segment, with noise."""
    generator = np.random.default_rng(seed)
    segments, begin_s = [], 0.0
    for index, (times_s, target_rad, target_rad_s, q, v) in enumerate(motions):
        series = JointSeries(
            commanded_rad=target_rad,
            commanded_rad_s=target_rad_s,
            measured_rad=q + noise[0] * generator.standard_normal(len(q)),
            measured_rad_s=v + noise[1] * generator.standard_normal(len(v)),
        )
        segments.append(
            Segment(pose="p", joint=joint, signal=f"s{index}", times_s=times_s + begin_s, series={joint: series})
        )
        begin_s += times_s[-1] + times_s[1]
    return Recording(
        robot="r",
        recorded="simulated",
        control=control,
        joints=(joint,),
        segments=tuple(segments),
        digest="0" * 64,
        commands=commands,
    )


def motions_of(servo, speeds=(0.2, 1.0), *, velocity_control=True, is_interpolated=False, **course):
    """The motion of a servo under steps, by explicit Euler."""
    from dataclasses import replace

    under = replace(servo, position_gain_hz2=0.0) if velocity_control else servo
    found = []
    for speed in speeds:
        times_s, positions, velocities = course_of(speed, **course)
        found.append(
            (
                times_s,
                positions,
                velocities,
                *euler_motion(under, times_s, positions, velocities, is_interpolated=is_interpolated),
            )
        )
    return found
