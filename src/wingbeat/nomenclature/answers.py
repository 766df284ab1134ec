"""Names of results: numbers of one wingbeat, the solver's report, and a study's own columns."""

from __future__ import annotations

from wingbeat.nomenclature.term import Term

BEAT = (
    Term("mean_power", "W", "mean hinge power, both wings", short="hinge power, mean"),
    Term(
        "mean_positive_power",
        "W",
        "mean of the positive part of the hinge power, both wings",
        short="hinge power, mean of the positive part",
    ),
    Term("peak_power", "W", "largest hinge power, both wings", short="hinge power, peak"),
    Term("mean_actuator_power", "W", "mean actuator power, both wings", short="actuator power, mean"),
    Term("peak_actuator_power", "W", "largest actuator power, both wings", short="actuator power, peak"),
    Term("positive_power_per_mass", "W kg-1", "mean positive hinge power divided by the whole mass"),
    Term("minimum_power_speed", "m s-1", "speed of minimum power"),
    Term("power_cost", "W", "mean hinge power with a share of the negative work recovered"),
    Term("spring_power", "W", "mean positive hinge power with springs at the flap hinges"),
    Term("stiffness", "N m rad-1", "stiffness of the springs at both flap hinges together", "k"),
    Term("rest_angle", "rad", "flap angle at which the springs exert no torque"),
    Term("metabolic_power", "W", "mean metabolic power of the flight muscles"),
    Term(
        "peak_activation",
        "1",
        "largest share of its fibres that a flight muscle must use; above 1, the muscle is too weak",
        short="largest activation",
    ),
    Term(
        "muscle_power_per_mass", "W kg-1", "mean positive power of the flap hinges' muscles divided by their mass"
    ),
    Term(
        "muscle_work_per_mass", "J kg-1", "positive work per beat of the flap hinges' muscles divided by their mass"
    ),
    Term("muscle_efficiency", "1", "mean positive power of the muscles divided by their metabolic power"),
    Term(
        "electrical_power",
        "W",
        "mean positive electrical power of the motor plus mean positive power of the pitch hinges",
    ),
    Term("peak_motor_torque", "N m", "largest absolute value of the motor's torque"),
    Term("rms_motor_torque", "N m", "root mean square of the motor's torque"),
    Term("peak_motor_speed", "rad s-1", "largest absolute value of the motor's speed"),
    Term("peak_motor_voltage", "V", "largest absolute value of the voltage at the motor's terminals"),
    Term("rms_motor_current", "A", "root mean square of the motor's current"),
    Term("cost_of_transport", "1", "mean positive power divided by weight times speed", short="cost of transport"),
    Term("peak_force_over_weight", "1", "largest air load on the whole vehicle divided by its weight"),
    Term("peak_flap_torque", "N m", "largest absolute value of the flap torque, both wings"),
    Term("peak_pitch_torque", "N m", "largest absolute value of the wing pitch torque, both wings"),
    Term(
        "body_pitch_range",
        "rad",
        "largest minus smallest body pitch",
        "",
        "largest minus smallest body pitch within a wingbeat",
        "range of body pitch",
    ),
    Term("roughness", "m s-2", "root mean square of the body's acceleration"),
    Term("strouhal", "1", "Strouhal number", "St", "2 f semi_span sin(flap_amplitude) / U"),
    Term("reduced_frequency", "1", "reduced frequency", "k"),
    Term(
        "reynolds",
        "1",
        "Reynolds number of the mean chord",
        "Re",
        "U times mean chord over viscosity",
        "Reynolds number",
    ),
    Term(
        "alpha_quarter_span",
        "rad",
        "smallest and largest effective angle of attack at 1/4 span",
        short="effective alpha at 1/4 span",
    ),
    Term(
        "alpha_three_quarter_span",
        "rad",
        "smallest and largest effective angle of attack at 3/4 span",
        short="effective alpha at 3/4 span",
    ),
)
ANSWER = (
    Term("status", "", "how the solver ended"),
    Term("message", "", "message of the solver"),
    Term("species", "", "name of the species"),
    Term("objective", "", "name of the minimised quantity"),
    Term("objective_value", "1", "minimised quantity"),
    Term("optimality", "1", "largest residual of the optimality conditions, scaled"),
    Term("starts", "1", "number of starts"),
    Term("distinct_optima", "1", "number of distinct optima found"),
    Term("starts_at_best", "1", "number of starts that ended at the best optimum"),
    Term("active_bounds", "", "bounds and limits that the orbit has reached"),
    Term("failed_balance", "", "balances that fail, and by how much"),
    Term("relaxations", "", "smallest single changes that give an orbit"),
    Term("plausibility", "", "numbers of the orbit that have plausible ranges, with these ranges"),
    Term("floquet_multipliers", "1", "Floquet multipliers of the orbit"),
    Term("largest_multiplier", "1", "largest modulus of the Floquet multipliers"),
    Term("spectral_radius", "1", "largest modulus of the multipliers of (body_pitch, u, w, pitch_rate)"),
    Term(
        "gust_response",
        "s m-1",
        "root mean square of the disturbance, in units of 0.1 rad, 1 m/s, 1 m/s and 2 rad/s, per m/s of gusts that "
        "change at random from beat to beat",
        short="response to gusts",
    ),
    Term("stable", "1", "whether every Floquet multiplier lies within the unit circle"),
    Term("warnings", "", "what to know before trusting the orbit"),
    Term("solve_seconds", "s", "time to solve"),
    Term("version", "", "version of wingbeat"),
    Term("optimum", "", "rank of the optimum at its speed; 0 is the best"),
    Term("family", "", "number of the family of orbits, -1 if none"),
    Term(
        "continued",
        "",
        "continuation steps between an optimum and one at the next speed, 0 if continuation does not link them",
    ),
)
STUDY = (
    Term("key", "", "digest that names the point"),
    Term(
        "certificate",
        "1",
        "largest residual of the re-flown orbit, among lengths, angles and velocities in SI units",
    ),
    Term("error", "", "why the point has no result"),
    Term("run_seconds", "s", "time to solve the point"),
    Term("run_finished", "", "when the point was finished, UTC"),
    Term("run_worker", "", "worker that solved the point"),
    Term("run_attempt", "1", "number of attempts at the point"),
    Term("species_given", "", "species as the study names it"),
    Term("aero_given", "", "coefficients as the study names them"),
    Term("minimise", "", "quantity to minimise"),
    Term("subject_to", "", "limits of the problem"),
    Term("seed", "1", "seed of the random starts"),
    Term("most_starts", "1", "largest number of starts"),
)
