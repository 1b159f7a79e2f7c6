# shellcheck shell=bash
# Sourced by scripts that read recordings in TUM layout: the sequence file of a folder. They set $root (the checkout) and
# $program (their name, for messages).
: "${root:?}" "${program:?}"

fail() { echo "$program: $*" >&2; exit 1; }
wrong_call() { echo "$program: $* (--help explains)" >&2; exit 2; }
quoted() { local text=${1//\\/\\\\}; printf '"%s"' "${text//\"/\\\"}"; }  # for YAML

# camera_from_line FILE: the YAML mapping of a camera given as one line of numbers.
camera_from_line() {
  awk -v file="$1" -v program="$program" '
    function wrong(what) { print program ": " file ": " what > "/dev/stderr"; failed = 1; exit 2 }
    { sub(/\r$/, "") }
    /^[ \t]*(#|$)/ { next }
    lines++ { wrong("expected one line of numbers, found a second: " $0) }
    NF != 7 && NF != 11 && NF != 12 {
      wrong("expected fx fy cx cy width height depth_scale [k1 k2 p1 p2 [k3]], found " NF " values") }
    { for (i = 1; i <= NF; i++) if ($i !~ /^[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?$/)
        wrong("expected a number, found " $i)
      printf "{fx: %s, fy: %s, cx: %s, cy: %s, width: %s, height: %s, depth_scale: %s", $1, $2, $3, $4, $5, $6, $7
      if (NF > 7) printf ", distortion: [%s, %s, %s, %s, %s]", $8, $9, $10, $11, NF == 12 ? $12 : 0
      print "}" }
    END { if (!failed && !lines) wrong("expected one line of numbers, found none") }' "$1"
}

# camera_of CHOICE FOLDER: what to write behind "camera:" in a sequence file.
camera_of() {
  local choice=$1 folder=$2
  if [ -z "$choice" ]; then
    if [ -f "$folder/camera.txt" ]; then choice=$folder/camera.txt; else
      case "$(basename "$folder")" in
        *freiburg1*) choice=fr1 ;;
        *freiburg2*) choice=fr2 ;;
        *freiburg3*) choice=fr3 ;;
        *) wrong_call "the camera of $folder is unknown. Say it in one of three ways: --camera fr1|fr2|fr3|FILE; a file" \
          "$folder/camera.txt with the line \"fx fy cx cy width height depth_scale [k1 k2 p1 p2 [k3]]\"; a folder name" \
          "with freiburg1, freiburg2 or freiburg3 in it" ;;
      esac
    fi
  fi
  case "$choice" in
    fr[123]) quoted "$root/configs/cameras/freiburg${choice#fr}.yaml" ;;
    *)
      [ -f "$choice" ] || wrong_call "--camera: $choice is neither fr1, fr2, fr3 nor a file"
      case "$choice" in *.yaml | *.yml) quoted "$(realpath -s "$choice")" ;; *) camera_from_line "$choice" ;; esac ;;
  esac
}

# write_sequence FOLDER CAMERA FILE
write_sequence() {
  local list
  for list in rgb.txt depth.txt; do
    [ -f "$1/$list" ] || wrong_call "$1 is no sequence in TUM layout: it has no $list"
  done
  {
    echo "# Written by scripts/$program.sh"
    echo "root: $(quoted "$1")"
    echo "camera: $2"
    [ ! -f "$1/groundtruth.txt" ] || echo "groundtruth: groundtruth.txt"
    [ ! -f "$1/accelerometer.txt" ] || echo "accelerometer: accelerometer.txt"
  } >"$3"
}
