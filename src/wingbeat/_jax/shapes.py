"""Array shapes as type aliases for signatures; the tests check every call against them.

Within a call, axes with the same name have the same size. ``*phases`` stands for any number of axes, including none
for a single instant. An axis marked ``#`` may have length one or be left out. The type of array is open, because
the same equation takes JAX arrays and tracers, NumPy arrays and plain floats. Only type checkers (through `arrays`)
and tests import this module, because importing `jaxtyping` takes 30 ms.
"""

from __future__ import annotations

from typing import Any

from jaxtyping import Float, Int

Scalar = Float[Any, ""]
# Parameters of the wingbeat that are free.
Free = Float[Any, "free"]
# Angles of attack, any shape.
Angles = Float[Any, "*angles"]
# Coefficients of a cubic spline, constant first; and of a table's curves, one column for each piece.
Spline = Float[Any, "4 pieces"]
PieceColumns = Float[Any, "numbers pieces"]
Cells = Float[Any, "cells"]
# A family of polars: logarithms of their Reynolds numbers, quintics between them, widths of both ends, weights.
FamilyNodes = Float[Any, "members"]
FamilyBasis = Float[Any, "6 gaps members"]
FamilyEnds = Float[Any, "2"]
FamilyWeights = Float[Any, "members *angles"]
# Angles of a table's rows, and values at them.
Knots = Float[Any, "knots"]

# One number at each phase, or at each instant [s].
Phases = Float[Any, "*phases"]
# One number for each strip, at each phase: strips come first, because XLA on CPU works along the last axis.
PerStrip = Float[Any, "strips *phases"]
# The same, where what does not change has axes of length one; or one number for each of some strips, each at a
# phase of its own.
PerStripBroadcast = Float[Any, "strips *#phases"]
# The same, or None for what is zero; a vector of such components.
PerStripOrNone = PerStripBroadcast | None
TripleOrNone = tuple[PerStripOrNone, PerStripOrNone, PerStripOrNone]
# Components of vectors as separate arrays: forward and up in the plane of symmetry, or forward, left and up.
Component = Float[Any, "*#components"]
Pair = tuple[Component, Component]
Triple = tuple[Component, Component, Component]

Vectors = Float[Any, "*#components 3"]
# One number for each of (V_x, V_z, psi'), at each phase.
ByBodyMotion = Float[Any, "3 *phases"]
# Sums over the strips.
Sums = Float[Any, "sums *phases"]

# (body_pitch, u, w, pitch_rate), their rates, and the body's acceleration (x'', z'', psi'').
PitchState = Float[Any, "4 *phases"]
# The same, and with the lag of the wake two states of each strip after it: first z_1 of all strips, then z_2.
FlightState = Float[Any, "states *phases"]
WakeStates = Float[Any, "2 strips *phases"]
# Numbers of the lag of the wake: of its two states; of both sides of a polar, or of each strip's.
PairOfNumbers = Float[Any, "2"]
StallNumbers = Float[Any, "2 ..."]
# Derivatives of the body's acceleration by the downwash of each strip's wake.
ByStripWake = Float[Any, "3 strips lanes"]
BodyAcceleration = Float[Any, "3 *phases"]
# (x, z, body_pitch, flap, wing_pitch), their rates, and generalised forces.
Coordinates = Float[Any, "*phases 5"]
CoordinateMatrix = Float[Any, "*phases 5 5"]
# Flap angles of arm and hand.
FlapAngles = Float[Any, "2 *phases"]

# Vectors (x, y, z) in the world: of strips, and of the corners of each.
StripVectors = Float[Any, "*phases strips 3"]
Corners = Float[Any, "*phases strips 4 3"]
ChordFractions = Float[Any, "rows"]
Stations = Float[Any, "stations"]
SurfacePoints = Float[Any, "*phases rows stations 3"]
# Points of a wing at one instant, and of the two mass points of each strip; their derivatives have more axes.
StripPoints = Float[Any, "strips 3 ..."]
MassPoints = Float[Any, "2 strips 3 ..."]
# Speeds of strips by the rates of the five coordinates, and a vector in the world.
StripsByCoordinates = Float[Any, "strips 5"]
Vector = Float[Any, "3"]
# Series along a flight: of the body, of each strip, and vectors (x, z) and (x'', z'', psi'').
PhasesStrips = Float[Any, "*phases strips"]
PhasesPair = Float[Any, "*phases 2"]
PhasesAcceleration = Float[Any, "*phases 3"]

# Along one flown period: a series, and (body_pitch, u, w, pitch_rate) at each sample; states of the integrator.
Samples = Float[Any, "samples"]
Path = Float[Any, "samples 4"]
StateVector = Float[Any, "6"]
StartState = Float[Any, "state"]
StatePath = Float[Any, "samples state"]
StepTimes = Float[Any, "steps"]
StepStates = Float[Any, "steps state"]
Integrated = tuple[StatePath, StepTimes, StepStates]
# Velocity of the air, forward and up: in a table along a beat, and at one phase.
AirTable = Float[Any, "places 2"]
AirVelocity = Float[Any, "2"]
# A beat and its derivatives, whose first axis is directions.
Series = Float[Any, "... samples"]
StripSeries = Float[Any, "... samples strips"]
Number = Float[Any, "..."]
PitchTangents = Float[Any, "directions 4 samples"]
# Derivatives of a field of a beat: by the free parameters, by the state at the same phase, and by all unknowns.
FieldByFree = Float[Any, "free *rest"]
FieldByState = Float[Any, "4 *rest"]
FieldTangents = Float[Any, "directions *rest"]
# Peaks of series in each quarter of the beat, and what they are interpolated from.
SampledSeries = Float[Any, "samples *columns"]
Quarters = Float[Any, "4 *columns"]
SamplesOfPeaks = Int[Any, "4 4 *#columns"]
Indices = Int[Any, "*indices"]
Columns = Float[Any, "*columns"]

# A flight in fixed steps: tables of the wing's motion in rows, all stages of all steps, and tangents.
TableRows = Float[Any, "entries *times"]
TableTangents = Float[Any, "free entries times"]
Stages = Float[Any, "4 4 steps"]
StateTangents = Float[Any, "4 4 4 steps"]
FreeTangents = Float[Any, "free 4 4 steps"]
LinearMap = Float[Any, "4 components *rest"]
Tangents = Float[Any, "directions 4 *rest"]
MappedTangents = Float[Any, "directions components *rest"]
FlownPath = Float[Any, "samples components"]
EndJacobian = Float[Any, "6 unknowns"]
PathJacobian = Float[Any, "samples components unknowns"]
# Derivatives of the pitch state's rates by the pitch state, states first.
RatesByState = Float[Any, "4 4 samples"]
# The pitch state and a hinge after a beat by those before it, and what is computed from its eigenvalues.
StrokeMatrix = Float[Any, "states states"]
Moduli = Float[Any, "states"]
CoefficientsOfMap = Float[Any, "states"]
Excesses = Float[Any, "conditions"]
# Distances of the stroke from its limits.
StrokeSeries = Float[Any, "series samples"]
StrokeRows = Float[Any, "rows"]
StrokeIndices = Int[Any, "rows"]
StrokeJacobian = Float[Any, "rows free"]
# Stretches of a path that are flown at once, and the linear maps of the pitch state over them.
Stretches = Float[Any, "stretches"]
StretchStates = Float[Any, "stretches 4"]
StretchMaps = Float[Any, "stretches 4 4"]
# Derivatives by parameters of each law of the wing and of its rate, at the top of the stroke; positions and rates.
LawJumps = Float[Any, "laws 2 *free"]
# Laws of the wing and their rates at the top of the stroke; changes of inputs, and parameters, of several flights.
LawRates = Float[Any, "laws 2"]
Commands = Float[Any, "inputs *flights"]
Parameters = Float[Any, "parameters *flights"]
# Changes of inputs and all parameters of one wingbeat, and the derivatives of these by those.
InputChanges = Float[Any, "inputs"]
AllParameters = Float[Any, "parameters"]
ParameterSlopes = Float[Any, "parameters inputs"]
# Many flights at once: one number of each, their states, velocities of the air, and what is measured.
Flights = Float[Any, "flights"]
FlightStates = Float[Any, "6 flights"]
AirOfFlights = Float[Any, "flights places 2"]
NoiseOfFlights = Float[Any, "beats segments readings flights"]
FlownTops = Float[Any, "beats 6 flights"]
FlownSamples = Float[Any, "beats segments states flights"]
FlownCommands = Float[Any, "beats segments commands flights"]
FlownTimes = Float[Any, "beats flights"]
# States of one flight at the starts of steps, and the derivatives of the steps by states and servos.
ServoStates = Float[Any, "steps states"]
ServoMaps = Float[Any, "ends directions steps"]
