#!/usr/bin/env bash
# One would guess: a number that Python writes is a number to YAML.
# What happens: PyYAML, which reads YAML 1.1, takes 1e-05 as a text, because the mantissa has no point; ruamel.yaml,
# which reads YAML 1.2, takes it as a number. Python's repr writes 1e-05, and PyYAML's own writer 1.0e-05.
# Where it bites: messages and parameters that a program writes for ROS 2, which reads them with PyYAML: one small
# value in a thousand turns a list of numbers into a list of numbers and texts.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv env
env/bin/pip install -q --disable-pip-version-check "pyyaml==6.0.3" "ruamel.yaml==0.19.1"
env/bin/python - <<'PY'
import sys

import yaml
from ruamel.yaml import YAML

text = repr([0.5, 1e-05])
found = {"PyYAML": yaml.safe_load(text), "ruamel.yaml": list(YAML(typ="safe").load(text))}
print(f"PyYAML {yaml.__version__}: {text} is {found['PyYAML']}; ruamel.yaml: {found['ruamel.yaml']}")
print(f"PyYAML writes {yaml.safe_dump(1e-05).split()[0]}")
sys.exit(found != {"PyYAML": [0.5, "1e-05"], "ruamel.yaml": [0.5, 1e-05]})
PY
