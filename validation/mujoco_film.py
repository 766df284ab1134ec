"""Film a pigeon in MuJoCo, pushed by half a metre per second: on the left alone, on the right with feedback.

    MUJOCO_GL=osmesa python validation/mujoco_film.py

It needs the extra ``mujoco`` and a library that draws without a screen (OSMesa or EGL). The picture goes to
``docs/guide/mujoco.gif``.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import mujoco
import numpy as np
from PIL import Image, ImageDraw

import wingbeat as wb

# The library has no types.
engine: Any = mujoco
PICTURE = Path(__file__).parents[1] / "docs" / "guide" / "mujoco.gif"
BEATS, STEPS, FRAMES = 16, 64, 8  # beats flown, and MuJoCo's steps and pictures in each
WIDTH, HEIGHT = 300, 240  # of each half [pixels]
PUSH = {"w": 0.5, "body_pitch": 0.1}
SLOWER, COLOURS = 8, 64  # times slower than real, and colours of the picture


def flown(orbit: wb.Orbit, controller: wb.FeedbackController | None) -> list[np.ndarray]:
    """Return the pictures of a flight that starts beside the orbit; the camera moves with the body."""
    flight = wb.MujocoFlight(orbit, STEPS)
    start = orbit.initial_state
    pushed = start._replace(**{name: getattr(start, name) + by for name, by in PUSH.items()})
    flight.data.qpos[:3], flight.data.qvel[:3] = pushed[:3], pushed[3:]
    positions = flight.fly(BEATS, controller).positions[: -1 : STEPS // FRAMES]
    camera = engine.MjvCamera()
    camera.azimuth, camera.elevation, camera.distance = 130.0, -15.0, 0.95
    light = flight.model.vis.headlight
    light.ambient[:], light.diffuse[:] = 0.6, 0.7
    flight.model.geom_rgba[:, 3] = 1.0
    shown, pictures = engine.MjData(flight.model), []
    with engine.Renderer(flight.model, HEIGHT, WIDTH) as renderer:
        for position in positions:
            shown.qpos[:] = position
            engine.mj_forward(flight.model, shown)
            camera.lookat[:] = (position[0], 0.0, position[1])
            renderer.update_scene(shown, camera)
            pictures.append(renderer.render().copy())
    return pictures


def labelled(free: np.ndarray, held: np.ndarray, beat: float) -> Image.Image:
    """Return both pictures side by side, with words."""
    both = Image.fromarray(np.hstack([free, held]))
    draw = ImageDraw.Draw(both)
    for left, words in ((0, "gait alone"), (WIDTH, "gait with feedback")):
        draw.text((left + 8, 6), words, fill="white")
    draw.text((8, HEIGHT - 18), f"beat {beat:.1f}", fill="white")
    return both


def main() -> None:
    """Fly, draw and save."""
    robot = wb.load_species("pigeon").with_values({"wingbeat.span_retraction": 0.0})
    orbit = wb.solve_orbit(wb.OrbitProblem(robot, speed=8.0), starts=2)
    flights = flown(orbit, None), flown(orbit, wb.feedback(orbit).controller())
    pictures = [
        labelled(free, held, k / FRAMES).quantize(COLOURS)
        for k, (free, held) in enumerate(zip(*flights, strict=True))
    ]
    pause = round(1000.0 * SLOWER / FRAMES / orbit.wingbeat.frequency)
    pictures[0].save(PICTURE, save_all=True, append_images=pictures[1:], duration=pause, loop=0, optimize=True)


if __name__ == "__main__":
    main()
