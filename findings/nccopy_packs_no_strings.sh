#!/usr/bin/env bash
# One would guess: `nccopy -d5` packs what can be packed and copies the rest; other readers show both kinds of text.
# What happens: a variable of strings (NC_STRING, as xarray writes texts by default) ends the copy with "Filter error:
# bad id or parameters", for the filter is asked of every variable. Octave's netcdf package reads no NC_STRING either:
# ncreadatt returns nothing, ncread says "unknown type 12", ncinfo ends. Texts of characters (NC_CHAR) pass both.
# Where it bites: every xarray file with a text coordinate, or with units written as Python texts.
set -euo pipefail
for program in ncgen nccopy octave-cli; do
  command -v "$program" >/dev/null || { echo "install netcdf-bin, octave and octave-netcdf"; exit 77; }
done
octave-cli -qf --eval "pkg load netcdf" >/dev/null 2>&1 || { echo "install octave-netcdf"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
cat >strings.cdl <<'CDL'
netcdf strings {
dimensions: side = 2 ;
variables: string side(side) ; double power(side) ; string power:units = "W" ;
data: side = "left", "right" ; power = 1, 2 ;
}
CDL
cat >chars.cdl <<'CDL'
netcdf chars {
dimensions: side = 2 ; letters = 5 ;
variables: char side(side, letters) ; double power(side) ; power:units = "W" ;
data: side = "left", "right" ; power = 1, 2 ;
}
CDL
nccopy 2>&1 | grep -i "library version" || true
octave-cli --version | head -1
for kind in strings chars; do
  ncgen -4 -o "$kind.nc" "$kind.cdl"
  said=$(nccopy -d5 "$kind.nc" packed.nc 2>&1) && packed=yes || packed="no: ${said%%$'\n'*}"
  units=$(octave-cli -qf --eval "pkg load netcdf; printf('%s', ncreadatt('$kind.nc', 'power', 'units'))" 2>&1) || true
  echo "$kind: nccopy -d5: $packed; Octave reads the unit: ${units%%$'\n'*}"
  case $kind in
    strings) [[ $packed == no* && $units != W* ]] || { echo "the behaviour has changed"; exit 1; } ;;
    chars) [[ $packed == yes && $units == W* ]] || { echo "the behaviour has changed"; exit 1; } ;;
  esac
done
