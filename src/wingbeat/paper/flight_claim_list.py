"""The paper's claims about flight that are tested under every treatment, and most of them under every set."""

from __future__ import annotations

from wingbeat.paper import energy_claims as energy
from wingbeat.paper import flight_claims as flight
from wingbeat.paper.claim import FlightClaim
from wingbeat.paper.pigeon_claims import closer_at_speed, pigeon_claims
from wingbeat.paper.treatments import ANIMALS

_RESULTS, _DISCUSSION = "results, simulations", "discussion, simulations"


def flight_claim_list() -> list[FlightClaim]:
    """Return the claims about flight that are tested under every treatment."""
    return [
        FlightClaim(
            "closed-loops",
            "results, sample orbit",
            "height, pitch and velocities return after a wingbeat: their loops are closed (tested: when an "
            "independent integrator flies the orbit, the largest residual in SI units is at most 1e-6)",
            "closed",
            "SI",
            flight.closed_loops,
        ),
        FlightClaim(
            "open-loop",
            "results, sample orbit",
            "the loop of u against x stays open by the distance flown (tested: the distance gained in a wingbeat "
            "is speed times period)",
            "open",
            "m",
            flight.open_loop,
        ),
        FlightClaim(
            "printed-sign",
            "methods, periodic orbit",
            "the periodicity condition as printed, q(t) = q(t+T) + U T, gives forward flight (ours: the speed it "
            "gives)",
            10.0,
            "m/s",
            flight.printed_sign,
        ),
        FlightClaim(
            "stable",
            "methods, simulation",
            "the solutions found are stable periodic ones (tested: every Floquet multiplier of body pitch, "
            "velocities and pitch rate has a modulus below 1; ours: the largest modulus over all Su-Fan orbits)",
            "stable",
            "1",
            flight.stable,
        ),
        FlightClaim(
            "least-frequency",
            "methods, simulation",
            "the optimisation finds the one wingbeat of lowest frequency (tested: for every problem, all starts "
            "end at the same optimum; ours: the largest number of distinct optima found for one problem)",
            "the one",
            "1",
            flight.least_frequency,
        ),
        *pigeon_claims(),
        closer_at_speed("bat-closer-at-speed", "bat", flight.BAT_MEASURED, "as in the paper"),
        FlightClaim(
            "bat-slow-alike",
            _RESULTS,
            "up to 5 m/s both models give the bat a similar frequency (tested: Dickinson's frequency divided by "
            "Su-Fan's is within 15 % of 1; ours: the ratio farthest from 1)",
            "similar",
            "1",
            flight.bat_slow_alike,
        ),
        FlightClaim(
            "bat-parts",
            _RESULTS,
            "above 5 m/s the two models' frequencies for the bat diverge (tested: Dickinson's frequency divided by "
            "Su-Fan's rises with speed up to 12 m/s; ours: the slope of this ratio against speed)",
            "> 0",
            "s/m",
            flight.bat_parts,
        ),
        FlightClaim(
            "bat-agrees",
            _RESULTS,
            f"from 5 to 10 m/s the bat's frequency agrees very well with the measured {flight.BAT_MEASURED:g} Hz "
            "(tested: the mean deviation is at most 15 %)",
            "very well",
            "1",
            flight.bat_agrees,
        ),
        FlightClaim(
            "bat-invariant",
            "results; discussion",
            "live animals' frequency does not change with speed, and the predicted one agrees from 5 to 10 m/s "
            "(tested, in our reading: at these speeds the range of the predicted frequency is at most 15 % of "
            "its mean)",
            "agrees",
            "1",
            flight.bat_invariant,
        ),
        FlightClaim(
            "twice-the-frequency",
            _DISCUSSION,
            "near 10 m/s Dickinson's frequency is almost twice Su-Fan's (tested: for the bat, the ratio is "
            "between 1.7 and 2.3)",
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
            "with both models the hand has the larger angle of attack (tested: for the bat at 10 m/s, the mean "
            "absolute angle is larger at 3/4 span than at 1/4 span; ours: the difference, the smaller of the two "
            "models' values)",
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
            "with both models the hand produces the thrust (tested: its mean force points forward; ours: the "
            "mean forward force divided by weight, the smaller of the two models' values)",
            "> 0",
            "1",
            flight.hand_thrusts,
        ),
        FlightClaim(
            "arm-drags",
            _DISCUSSION,
            "with both models the arm has more drag than the hand (tested: the mean forward force at 1/4 span is "
            "below that at 3/4 span; ours: the difference divided by weight, the larger of the two models' "
            "values)",
            "< 0",
            "1",
            flight.arm_drags,
        ),
        FlightClaim(
            "arm-pitches-least",
            _DISCUSSION,
            "with Su-Fan the arm needs little pitching (tested: for the bat at 10 m/s, the pitch amplitude of "
            "the wing's root is smaller than with Dickinson; ours: Su-Fan's amplitude minus Dickinson's)",
            "< 0",
            "deg",
            flight.arm_pitches_least,
        ),
        FlightClaim(
            "force-balance",
            _DISCUSSION,
            "averaged over a wingbeat, lift equals weight and thrust equals drag (tested: the mean forces, from "
            "256 samples, deviate from this by less than 0.01 of the weight)",
            0.0,
            "1",
            flight.force_balance,
        ),
        energy.peak_power("su-fan"),
        energy.peak_power("dickinson"),
        FlightClaim(
            "four-times",
            _DISCUSSION,
            "Dickinson's peak power at 10 m/s is four times Su-Fan's (tested: for the bat, the ratio is between "
            "3 and 5; the paper's own peaks give 5)",
            4.0,
            "1",
            energy.four_times,
        ),
        FlightClaim(
            "power-exponent",
            _DISCUSSION,
            "power goes roughly as frequency squared (tested: the two models' peak powers and frequencies at 10 "
            "m/s give an exponent between 1.5 and 2.5; ours: this exponent, or 0 if the frequencies are within 5 "
            "%)",
            2.0,
            "1",
            energy.power_exponent,
        ),
        FlightClaim(
            "measured-power-below",
            _DISCUSSION,
            "the power found for similar bats, less than 4 W, is below the bat's power with either model "
            "(tested: the peak powers of both models at 10 m/s are above 4 W; ours: the lower of the two)",
            "> 4",
            "W",
            energy.measured_power_below,
        ),
        FlightClaim(
            "lower-power",
            "abstract",
            "Su-Fan's coefficients lead to lower power (tested: for both animals, the mean positive power at 10 "
            "m/s is lower than with Dickinson; ours: Su-Fan's power divided by Dickinson's, the larger of the "
            "two animals' ratios)",
            "< 1",
            "1",
            energy.lower_power,
        ),
        energy.pitch_range("su-fan", bound=True),
        energy.pitch_range("dickinson", bound=False),
        FlightClaim(
            "few-degrees",
            _DISCUSSION,
            "the bat's body pitches by only a few degrees, as in live bats (tested: with Su-Fan, the range of "
            "body pitch at 10 m/s is at most 5 deg)",
            "few",
            "deg",
            energy.few_degrees,
        ),
        *(energy.less_pitching(animal) for animal in ANIMALS),
        FlightClaim(
            "differentiable",
            "discussion, last paragraph",
            "the formulas suit gradient-based optimisation (tested: the sample orbits, found by gradients, are "
            "optima: the largest residual of their optimality conditions is at most 1e-5)",
            "suitable",
            "1",
            flight.differentiable,
        ),
    ]
