"""The list of the paper's claims about flight that every treatment, and every set of the sample, is asked about."""

from __future__ import annotations

from wingbeat.paper import energy_claims as energy
from wingbeat.paper import flight_claims as flight
from wingbeat.paper.claim import FlightClaim
from wingbeat.paper.pigeon_claims import closer_at_speed, pigeon_claims
from wingbeat.paper.treatments import ANIMALS

_RESULTS, _DISCUSSION = "results, simulations", "discussion, simulations"
_PARTS = (
    "above 5 m/s the two models' frequencies for the bat diverge (tested: trend of Dickinson's frequency over "
    "Su-Fan's "
)


def flight_claim_list() -> list[FlightClaim]:
    """Return the claims about flight that every treatment is asked about."""
    return [
        FlightClaim(
            "closed-loops",
            "results, sample orbit",
            "height, pitch and velocities return after a wingbeat: their loops are closed (tested: largest "
            "residual in SI units, at most 1e-6, when flown by an independent integrator)",
            "closed",
            "SI",
            flight.closed_loops,
        ),
        FlightClaim(
            "open-loop",
            "results, sample orbit",
            "u against x stays open by the distance flown (tested: distance gained is speed times period)",
            "open",
            "m",
            flight.open_loop,
        ),
        FlightClaim(
            "printed-sign",
            "methods, periodic orbit",
            "the condition as printed, q(t) = q(t+T) + U T, gives forward flight (ours: the speed it gives)",
            10.0,
            "m/s",
            flight.printed_sign,
        ),
        FlightClaim(
            "stable",
            "methods, simulation",
            "the solutions found are stable periodic ones (tested: largest modulus of a Floquet multiplier of "
            "body pitch, velocities and pitch rate over all Su-Fan orbits, below 1)",
            "stable",
            "1",
            flight.stable,
        ),
        FlightClaim(
            "least-frequency",
            "methods, simulation",
            "the optimisation finds the one wingbeat of lowest frequency (tested: all starts end at one optimum, "
            "otherwise the result depends on the start; ours: largest number of distinct optima of one orbit)",
            "the one",
            "1",
            flight.least_frequency,
        ),
        *pigeon_claims(),
        closer_at_speed("bat-closer-at-speed", "bat", flight.BAT_MEASURED, "as in the paper"),
        FlightClaim(
            "bat-slow-alike",
            _RESULTS,
            "up to 5 m/s both models give the bat a similar frequency (tested: ratio within 15 %)",
            "similar",
            "1",
            flight.bat_slow_alike,
        ),
        FlightClaim("bat-parts", _RESULTS, f"{_PARTS}up to 12 m/s)", "> 0", "s/m", flight.bat_parts),
        FlightClaim(
            "bat-agrees",
            _RESULTS,
            f"from 5 to 10 m/s the bat's frequency agrees very well with the measured {flight.BAT_MEASURED:g} Hz "
            "(tested: mean deviation at most 15 %)",
            "very well",
            "1",
            flight.bat_agrees,
        ),
        FlightClaim(
            "bat-invariant",
            "results; discussion",
            "live animals' frequency does not change with speed, and the predicted one agrees from 5 to 10 m/s "
            "(tested, in our reading: spread of the predicted frequency there over its mean at most 15 %)",
            "agrees",
            "1",
            flight.bat_invariant,
        ),
        FlightClaim(
            "twice-the-frequency",
            _DISCUSSION,
            "near 10 m/s Dickinson's frequency is almost twice Su-Fan's (tested: bat, 1.7 to 2.3)",
            2.0,
            "1",
            flight.twice_the_frequency,
        ),
        flight.smaller_alpha(0.25),
        flight.smaller_alpha(0.75),
        flight.smaller_force(0, "horizontal"),
        flight.smaller_force(2, "vertical"),
        FlightClaim(
            "hand-alpha",
            _DISCUSSION,
            "with both models the hand has the larger angle of attack (tested: mean absolute value at 3/4 minus "
            "that at 1/4 span, bat at 10 m/s; ours: the smaller of the two)",
            "> 0",
            "deg",
            flight.hand_alpha_larger,
        ),
        FlightClaim(
            "arm-lifts",
            _DISCUSSION,
            "with both models the arm lifts more than the hand (tested: mean upward force over weight at 1/4 "
            "minus that at 3/4 span)",
            "> 0",
            "1",
            flight.arm_lifts,
        ),
        FlightClaim(
            "hand-thrusts",
            _DISCUSSION,
            "with both models the hand produces the thrust (tested: its mean forward force over weight)",
            "> 0",
            "1",
            flight.hand_thrusts,
        ),
        FlightClaim(
            "arm-drags",
            _DISCUSSION,
            "with both models the arm has more drag than the hand (tested: mean forward force over weight at 1/4 "
            "minus that at 3/4 span)",
            "< 0",
            "1",
            flight.arm_drags,
        ),
        FlightClaim(
            "arm-pitches-least",
            _DISCUSSION,
            "with Su-Fan the arm needs little pitching (tested: the root's pitch amplitude minus Dickinson's, bat "
            "at 10 m/s)",
            "< 0",
            "deg",
            flight.arm_pitches_least,
        ),
        FlightClaim(
            "force-balance",
            _DISCUSSION,
            "over a wingbeat lift equals weight and thrust equals drag (tested: largest deviation over weight, "
            "from 256 samples, below 0.01)",
            0.0,
            "1",
            flight.force_balance,
        ),
        energy.peak_power("su-fan"),
        energy.peak_power("dickinson"),
        FlightClaim(
            "four-times",
            _DISCUSSION,
            "Dickinson's peak power at 10 m/s is four times Su-Fan's (tested: bat, 3 to 5; the paper's own "
            "peaks give 5)",
            4.0,
            "1",
            energy.four_times,
        ),
        FlightClaim(
            "power-exponent",
            _DISCUSSION,
            "power goes roughly as frequency squared (tested: exponent from the two models' peaks at 10 m/s, 1.5 "
            "to 2.5; 0 if the frequencies are within 5 %)",
            2.0,
            "1",
            energy.power_exponent,
        ),
        FlightClaim(
            "measured-power-below",
            _DISCUSSION,
            "the power found for similar bats, less than 4 W, is below that of both models (tested: lower peak "
            "power)",
            "> 4",
            "W",
            energy.measured_power_below,
        ),
        FlightClaim(
            "lower-power",
            "abstract",
            "Su-Fan's coefficients lead to lower power (tested: mean positive power at 10 m/s, both animals; "
            "ours: the larger ratio to Dickinson's)",
            "< 1",
            "1",
            energy.lower_power,
        ),
        energy.pitch_range("su-fan", bound=True),
        energy.pitch_range("dickinson", bound=False),
        FlightClaim(
            "few-degrees",
            _DISCUSSION,
            "the bat's body pitches by only a few degrees, as in live bats (tested: Su-Fan's range at 10 m/s at "
            "most 5 deg)",
            "few",
            "deg",
            energy.few_degrees,
        ),
        *(energy.less_pitching(animal) for animal in ANIMALS),
        FlightClaim(
            "differentiable",
            "discussion, last paragraph",
            "the formulas suit gradient-based optimisation (tested: the sample orbits, found by gradients, are "
            "optima: largest residual of the optimality conditions at most 1e-5)",
            "suitable",
            "1",
            flight.differentiable,
        ),
    ]
