#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# farm_jobs_test.sh PROGRAMS SOURCE: the jobs of examples/cluster/frames by what reads them: OpenJD's own program,
# which renders two frames; OpenCue's library; Flamenco's script in node, with stand-ins for what Flamenco gives it.
# Status 77 where none of them is here (pip install openjd-cli opencue-pyoutline; Debian's nodejs).
set -u
programs=$(realpath "$1") jobs=$(realpath "$2")/examples/cluster/frames
PATH=$programs:$PATH
folder=$(mktemp -d /tmp/vitrail-jobs-XXXXXX)
trap 'rm -rf "$folder"' EXIT
tried=0
fail() { echo "failed: $*"; exit 1; }
cd "$folder" || exit 1

if command -v openjd > /dev/null; then
  tried=1
  openjd check "$jobs/openjd/template.yaml" || fail "openjd check"
  vitrail partition "$jobs/../../cornell-box/cornell-box.pbrt" -o box.vit --quiet || fail partition
  printf -- '--seed %d\n' 1 2 3 > list.txt
  openjd run "$jobs/openjd/template.yaml" -p Bundle="$folder/box.vit" -p List="$folder/list.txt" \
    -p Output="$folder/frame%d.png" -p Frames=2-3 -p Options="--width 16 --spp 4" > openjd.log 2>&1 || fail "$(tail openjd.log)"
  [ "$(echo frame?.png)" = "frame2.png frame3.png" ] || fail "openjd rendered $(echo frame*)"
fi

if python3 -c "import outline" 2> /dev/null; then
  tried=1
  python3 "$jobs/opencue_submit.py" "my room.vit" --frames list.txt --range 1-9x2 -o f%d.png --print -- --spp 4 > cue.xml ||
    fail opencue_submit.py
  grep -q "<cmd>vitrail render 'my room.vit' --frames list.txt -o f%d.png --retries 2 --spp 4 --range #IFRAME#</cmd><range>1-9x2</range>" \
    cue.xml || fail "$(cat cue.xml)"
fi

if command -v node > /dev/null; then
  tried=1
  cat > flamenco.js << 'END'
const author = {
  Task: (name, type) => ({ name, type, commands: [], addCommand(command) { this.commands.push(command); } }),
  Command: (name, parameters) => ({ name, parameters }),
};
const frameChunker = (range, size) => (range === "1-5" && size === 2 ? ["1-2", "3-4", "5"] : []);
END
  cat "$jobs/vitrail_frames.js" >> flamenco.js
  cat >> flamenco.js << 'END'
const settings = Object.fromEntries(JOB_TYPE.settings.map((s) => [s.key, s.default]));
Object.assign(settings, { bundle: "my room.vit", list: "list.txt", frames: "1-5", output: "f%d.png", chunk_size: 2 });
compileJob({ settings, addTask: (t) => console.log(t.name, t.type, t.commands[0].name, t.commands[0].parameters.exe, t.commands[0].parameters.args.join("|")) });
END
  node flamenco.js > flamenco.log || fail "vitrail_frames.js"
  [ "$(sed -n 3p flamenco.log)" = "frames 5 misc exec vitrail render|my room.vit|--frames|list.txt|-o|f%d.png|--range|5|--retries|2" ] ||
    fail "$(cat flamenco.log)"
fi
[ $tried = 1 ] || { echo "skipped: none of openjd, outline and node is here"; exit 77; }
echo passed
