"""The mechanics of flight: the wing's motion, the equations of motion, loads, and flights flown with them."""
