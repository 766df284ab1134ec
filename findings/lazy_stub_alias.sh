#!/usr/bin/env bash
# One would guess: `from ._parts import wing as flyer` in the stub that lazy_loader.attach_stub reads offers `flyer`,
# or is refused, as `import *` and imports from other packages are.
# What happens: the alias is dropped without a word. The running package offers `wing`, and `flyer` raises
# AttributeError when it is first used; a type checker knows neither, for in a stub only `X as X` passes a name on.
# Where it bites: a package that moves its public names into such a stub and renames one on the way.
set -euo pipefail
command -v python3 >/dev/null || { echo "install python3"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv env
env/bin/pip install --quiet "lazy-loader==0.6" "pyright[nodejs]==1.1.407"
mkdir bird
echo 'from ._parts import wing as flyer' >bird/__init__.pyi
printf '%s\n' 'import lazy_loader' '__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)' >bird/__init__.py
echo 'wing = 1' >bird/_parts.py
printf '%s\n' 'import bird' 'a = bird.flyer' 'b = bird.wing' >use.py
env/bin/pip list 2>/dev/null | grep -iE "lazy|pyright"
seen=$(env/bin/python -c "import bird; print(dir(bird), hasattr(bird, 'wing'), hasattr(bird, 'flyer'))")
echo "when it runs: dir, has wing, has flyer: $seen"
checked=$(env/bin/pyright use.py || true)
echo "pyright: $(grep -o '"[a-z]*" is not a known attribute' <<<"$checked" | paste -sd ,)"
[[ $seen == "['wing'] True False" && $checked == *'"wing" is not a known'* && $checked == *'"flyer" is not a known'* ]] ||
  { echo "the behaviour has changed"; exit 1; }
