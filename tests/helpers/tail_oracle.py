"""A plain oracle for the load of a tail, written from angles and coefficients with NumPy alone.

It shares no code with the package: lift and drag come from the angle of attack between the velocity of the tail's
centre and its chord, and act across and against that velocity. `vehicle` may have a dictionary "tail"; without one
there is no load.
"""

import math

import numpy as np

BROADSIDE = 1.17


def coefficients(lift_slope, drag_coefficient, alpha):
    """(c_l, c_d) at an angle of attack (rad). Theory: equation ``tail-coefficients``."""
    s, c = math.sin(alpha), math.cos(alpha)
    return lift_slope * s * c, drag_coefficient + lift_slope * s**2 * c**2 + BROADSIDE * s**4


def tail_load(vehicle, wingbeat, density, body_pitch, velocity, pitch_rate):
    """(force, place, velocity) in the world, each (x, z); place counts from the body's centre of mass.

    Theory: equations ``tail-velocity`` and ``tail-force``.
    """
    tail = vehicle.get("tail")
    if tail is None:
        return np.zeros(2), np.zeros(2), np.zeros(2)
    nose = np.array([math.cos(body_pitch), math.sin(body_pitch)])
    back = np.array([-math.sin(body_pitch), math.cos(body_pitch)])
    place = -tail["arm"] * nose + tail["height"] * back
    # Nose-up turns x towards z.
    moving = np.asarray(velocity) + pitch_rate * np.array([-place[1], place[0]])
    speed = math.hypot(*moving)
    if speed == 0.0:
        return np.zeros(2), place, moving
    leading = body_pitch + tail["incidence"] + wingbeat["tail_tilt"]
    c_l, c_d = coefficients(
        tail["lift_slope"], tail["drag_coefficient"], leading - math.atan2(moving[1], moving[0])
    )
    along = moving / speed
    across = np.array([-along[1], along[0]])
    return 0.5 * density * tail["area"] * speed**2 * (c_l * across - c_d * along), place, moving


def moment(force, place):
    """Nose-up moment (N m) about the body's centre of mass."""
    return place[0] * force[1] - place[1] * force[0]
