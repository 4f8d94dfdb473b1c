#!/bin/bash
# run_messages.sh - every message of src/script and src/model is provoked by a script test
set -u
cd "$(dirname "$0")/../.." || exit 3
"build/${CONFIG:-release}/unit/test_script" | grep '^# said: ' | "${PYTHON:-/usr/bin/python3}" tests/script/messages.py
