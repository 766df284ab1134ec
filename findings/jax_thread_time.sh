#!/usr/bin/env bash
# One would guess: with jax_cpu_enable_async_dispatch off, a program runs in the thread that calls it, so time.thread_time
# measures it (a single loop does run there).
# What happens: a program of several loops runs on threads of XLA while the caller waits. Of its time on the processor
# the thread that calls it sees about half on two cores; time.process_time sees all of it.
# Where it bites: benchmarks in thread time call such a program faster than it is, and services that bill or
# limit requests by the time of their thread.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv env
env/bin/pip install -q --disable-pip-version-check "jax==0.10.2" "jaxlib==0.10.2" "numpy==2.4.6"
env/bin/python - <<'PY'
import sys
import time

import jax
import jax.numpy as jnp

jax.config.update("jax_cpu_enable_async_dispatch", False)


def loop(start, count):
    return jax.lax.fori_loop(0, count, lambda _, x: jnp.sin(x) + 1.0, start)


def shares(function, count):
    program = jax.jit(function)
    x = jnp.linspace(0.0, 1.0, 512)
    jax.block_until_ready(program(x, count))
    thread, process = time.thread_time(), time.process_time()
    for _ in range(5):
        jax.block_until_ready(program(x, count))
    return (time.thread_time() - thread) / (time.process_time() - process)


one = shares(loop, 4000)
eight = shares(lambda x, n: [loop(x + k, n) for k in range(8)], 4000)
print(f"JAX {jax.__version__}: share of the processor's time that the calling thread sees")
print(f"one loop {one:.2f}, eight loops {eight:.2f}")
sys.exit(eight > 0.8)
PY
