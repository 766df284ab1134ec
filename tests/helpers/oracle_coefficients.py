"""The coefficients of the plain oracle: mirrored extension, away from the blends; no array, no package."""

import math


def blend_distance(alpha):
    """Distance in degrees from `alpha` (rad) to the nearest of 0, +-90 and 180 degrees."""
    return abs((math.degrees(alpha) + 45.0) % 90.0 - 45.0)


def mirrored(alpha, lift, drag):
    """Return lift and drag coefficients [1], the angle [deg] from 0 to 90, and whether the rear edge leads.

    `alpha` is the angle of attack of a plate [rad].
    """
    # Theory: equations ``folded-angle`` and ``mirrored-extension``.
    if blend_distance(alpha) < 1.0 - 1e-9:
        raise ValueError(f"alpha = {math.degrees(alpha)} deg lies within a degree of a blend centre")
    signed = math.degrees(math.atan2(math.sin(alpha), math.cos(alpha)))
    behind = abs(signed) > 90.0
    a = 180.0 - abs(signed) if behind else abs(signed)
    sign = math.copysign(1.0, signed) * (-1.0 if behind else 1.0)
    return sign * lift(a), drag(a), a, behind


def su_fan(alpha):
    """(c_l, c_d, x_cp) of Su and Fan at `alpha` (rad); x_cp in chords from the leading edge."""
    # Theory: equation ``su-fan``.
    c_l, c_d, a, behind = mirrored(
        alpha,
        lambda a: -0.44 * math.exp(-0.47 * a) + 1.19 * math.sin(math.radians(1.74 * a + 20.0)),
        lambda a: 1.04 + math.sin(math.radians(1.72 * a - 70.0)),
    )
    x_cp = 0.247 + 0.016 * a**0.6 + 0.026 * a * math.exp(-0.11 * a)
    return c_l, c_d, 1.0 - x_cp if behind else x_cp


def dickinson(alpha):
    """(c_l, c_d, 0.25) of Dickinson 1999 at `alpha` (rad); no centre of pressure was published."""
    # Theory: equation ``dickinson``.
    c_l, c_d, _, _ = mirrored(
        alpha,
        lambda a: 0.225 + 1.58 * math.sin(math.radians(2.13 * a - 7.2)),
        lambda a: 1.92 - 1.55 * math.cos(math.radians(2.04 * a - 9.82)),
    )
    return c_l, c_d, 0.25
