# What users find here, and where it lives: type checkers read this, and the package loads from it.

from .beat_feedback import Feedback as Feedback
from .beat_feedback import FeedbackController as FeedbackController
from .beat_feedback import feedback as feedback
from .causes import StabilitySensitivities as StabilitySensitivities
from .causes import stability_sensitivities as stability_sensitivities
from .gust_flights import fly_pushes as fly_pushes
from .imu import Imu as Imu
from .linear_flight import LinearFlight as LinearFlight
from .linear_flight import Mode as Mode
from .linear_flight import linearise as linearise
from .manoeuvres import Manoeuvre as Manoeuvre
from .manoeuvres import manoeuvre as manoeuvre
from .many_flights import GustSurvey as GustSurvey
from .many_flights import ManyFlights as ManyFlights
from .many_flights import simulate_many as simulate_many
from .many_flights import survey_gusts as survey_gusts
from .options import FeedbackOptions as FeedbackOptions
from .options import LinearOptions as LinearOptions
from .options import ManoeuvreOptions as ManoeuvreOptions
from .options import ManyOptions as ManyOptions
from .riccati import Reach as Reach
from .segment_feedback import SegmentFeedback as SegmentFeedback
from .segment_feedback import SegmentFlight as SegmentFlight
from .segment_feedback import feedback_in_beat as feedback_in_beat
from .servos import Servo as Servo
