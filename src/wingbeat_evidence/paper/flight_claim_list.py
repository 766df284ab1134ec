"""The paper's claims about flight. All are tested under every treatment, most also in the assumption study."""

from __future__ import annotations

from wingbeat_evidence.paper import energy_claims as energy
from wingbeat_evidence.paper import flight_claims as flight
from wingbeat_evidence.paper.claim import FlightClaim
from wingbeat_evidence.paper.pigeon_claims import closer_at_speed, pigeon_claims
from wingbeat_evidence.paper.treatments import ANIMALS

_RESULTS, _DISCUSSION = "results, simulations", "discussion, simulations"


def flight_claim_list() -> list[FlightClaim]:
    """Return the claims about flight that are tested under every treatment."""
    return [
        FlightClaim(
            "closed-loops",
            "results, sample orbit",
            "Height, pitch and velocities return after a wingbeat, so their loops are closed. Tested: an "
            "independent integrator flies the orbits at 10 m/s, and the largest residual of these states is at "
            "most 1e-6 in SI units. Ours: this residual.",
            "closed",
            "SI",
            flight.closed_loops,
        ),
        FlightClaim(
            "open-loop",
            "results, sample orbit",
            "The loop of u against x stays open by the distance flown. Tested: the distance that the pigeon gains "
            "in a wingbeat is speed times period. Ours: this distance.",
            "open",
            "m",
            flight.open_loop,
        ),
        FlightClaim(
            "printed-sign",
            "methods, periodic orbit",
            "The periodicity condition as printed, q(t) = q(t+T) + U T, gives forward flight. Ours: the forward "
            "speed that it gives.",
            10.0,
            "m/s",
            flight.printed_sign,
        ),
        FlightClaim(
            "stable",
            "methods, simulation",
            "The solutions found are stable periodic ones. Tested: all Floquet multipliers of body pitch, "
            "velocities and pitch rate have a modulus below 1. Ours: the largest modulus over all Su-Fan orbits.",
            "stable",
            "1",
            flight.stable,
        ),
        FlightClaim(
            "least-frequency",
            "methods, simulation",
            "The optimisation finds the one wingbeat of lowest frequency. Tested: in every problem with Su-Fan, "
            "all starts end at the same optimum. Ours: the largest number of distinct optima found in one problem.",
            "the one",
            "1",
            flight.least_frequency,
        ),
        *pigeon_claims(),
        closer_at_speed("bat-closer-at-speed", "bat", flight.BAT_MEASURED, "as in the paper"),
        FlightClaim(
            "bat-slow-alike",
            _RESULTS,
            "Up to 5 m/s both models give the bat a similar frequency. Tested: at every speed up to 5 m/s, "
            "Dickinson's frequency divided by Su-Fan's is within 15 % of 1. Ours: the ratio that differs most "
            "from 1.",
            "similar",
            "1",
            flight.bat_slow_alike,
        ),
        FlightClaim(
            "bat-parts",
            _RESULTS,
            "Above 5 m/s the two models' frequencies for the bat diverge. Tested: from 5 to 12 m/s, Dickinson's "
            "frequency divided by Su-Fan's rises with speed. Ours: the slope of this ratio against speed.",
            "> 0",
            "s/m",
            flight.bat_parts,
        ),
        FlightClaim(
            "bat-agrees",
            _RESULTS,
            "From 5 to 10 m/s the bat's frequency with Su-Fan agrees very well with the measured "
            f"{flight.BAT_MEASURED:g} Hz. Tested: the mean relative deviation is at most 15 %. Ours: this "
            "deviation.",
            "very well",
            "1",
            flight.bat_agrees,
        ),
        FlightClaim(
            "bat-invariant",
            "results; discussion",
            "The frequency of live animals does not change with speed, and the predicted frequency agrees with "
            "this from 5 to 10 m/s. Tested, as we read it: at these speeds the range of the bat's frequency with "
            "Su-Fan is at most 15 % of its mean. Ours: the range divided by the mean.",
            "agrees",
            "1",
            flight.bat_invariant,
        ),
        FlightClaim(
            "twice-the-frequency",
            _DISCUSSION,
            "Near 10 m/s Dickinson's frequency is almost twice Su-Fan's. Tested: for the bat at 10 m/s, the ratio "
            "is between 1.7 and 2.3.",
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
            "With both models the hand has a larger angle of attack than the arm. Tested: for the bat at 10 m/s, "
            "the mean absolute angle is larger at 3/4 span than at 1/4 span. Ours: the difference of these means, "
            "for the model with the smaller difference.",
            "> 0",
            "deg",
            flight.hand_alpha_larger,
        ),
        FlightClaim(
            "arm-lifts",
            _DISCUSSION,
            "With both models the arm lifts more than the hand. Tested: for the bat at 10 m/s, the mean upward "
            "force at 1/4 span is positive and larger than at 3/4 span. Ours: the difference of these forces "
            "divided by weight, for the model with the smaller difference.",
            "> 0",
            "1",
            flight.arm_lifts,
        ),
        FlightClaim(
            "hand-thrusts",
            _DISCUSSION,
            "With both models the hand produces the thrust. Tested: for the bat at 10 m/s, the mean force at 3/4 "
            "span points forward. Ours: this forward force divided by weight, for the model with the smaller "
            "force.",
            "> 0",
            "1",
            flight.hand_thrusts,
        ),
        FlightClaim(
            "arm-drags",
            _DISCUSSION,
            "With both models the arm has more drag than the hand. Tested: for the bat at 10 m/s, the mean forward "
            "force at 1/4 span is below that at 3/4 span. Ours: the arm's force minus the hand's, divided by "
            "weight, for the model with the larger value.",
            "< 0",
            "1",
            flight.arm_drags,
        ),
        FlightClaim(
            "arm-pitches-least",
            _DISCUSSION,
            "With Su-Fan the arm needs little pitching. Tested: for the bat at 10 m/s, the pitch amplitude of the "
            "wing's root is smaller than with Dickinson. Ours: Su-Fan's amplitude minus Dickinson's.",
            "< 0",
            "deg",
            flight.arm_pitches_least,
        ),
        FlightClaim(
            "force-balance",
            _DISCUSSION,
            "Averaged over a wingbeat, lift equals weight and thrust equals drag. Tested: at 10 m/s the mean "
            "forces, from 256 samples, deviate from this by less than 0.01 of the weight. Ours: the largest "
            "deviation divided by weight.",
            0.0,
            "1",
            flight.force_balance,
        ),
        energy.peak_power("su-fan"),
        energy.peak_power("dickinson"),
        FlightClaim(
            "four-times",
            _DISCUSSION,
            "Dickinson's peak power at 10 m/s is four times Su-Fan's. Tested: for the bat, the ratio is between 3 "
            "and 5. The paper's own peaks give 5.",
            4.0,
            "1",
            energy.four_times,
        ),
        FlightClaim(
            "power-exponent",
            _DISCUSSION,
            "Power goes roughly as frequency squared. Tested: the two models' peak powers and frequencies for the "
            "bat at 10 m/s give an exponent between 1.5 and 2.5. Ours: this exponent, or 0 if the two frequencies "
            "are within 5 % of each other.",
            2.0,
            "1",
            energy.power_exponent,
        ),
        FlightClaim(
            "measured-power-below",
            _DISCUSSION,
            "The power found for similar bats, less than 4 W, is below the bat's power with either model. Tested: "
            "at 10 m/s the peak powers of both models are above 4 W. Ours: the lower of the two.",
            "> 4",
            "W",
            energy.measured_power_below,
        ),
        FlightClaim(
            "lower-power",
            "abstract",
            "Su-Fan's coefficients lead to lower power. Tested: for both animals, the mean positive power at 10 "
            "m/s is lower than with Dickinson. Ours: Su-Fan's power divided by Dickinson's, for the animal with "
            "the larger ratio.",
            "< 1",
            "1",
            energy.lower_power,
        ),
        energy.pitch_range("su-fan", bound=True),
        energy.pitch_range("dickinson", bound=False),
        FlightClaim(
            "few-degrees",
            _DISCUSSION,
            "The bat's body pitches by only a few degrees, as in live bats. Tested: with Su-Fan, the range of body "
            "pitch at 10 m/s is at most 5 deg.",
            "few",
            "deg",
            energy.few_degrees,
        ),
        *(energy.less_pitching(animal) for animal in ANIMALS),
        FlightClaim(
            "differentiable",
            "discussion, last paragraph",
            "The formulas suit gradient-based optimisation. Tested: a gradient-based solver found the orbits at 10 "
            "m/s, and they are optima. Ours: the largest residual of their optimality conditions, which must be at "
            "most 1e-5.",
            "suitable",
            "1",
            flight.differentiable,
        ),
    ]
