"""Animals and robots: vehicle, wingbeat, actuators, and the species files that describe them."""
