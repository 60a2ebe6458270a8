#!/usr/bin/env bash
# The service against its own OpenAPI document, by schemathesis (pip install -r tests/load/requirements.txt): every check,
# stateful links on. Needs a built program; tests/load/contract.sh [examples per operation].
set -euo pipefail
cd "$(dirname "$0")"
program=${VOUSSOIR:-../../target/release/voussoir}
address=127.0.0.1:${PORT:-8092}
"$program" serve --bind "$address" --log warn &
trap 'kill $!' EXIT
until "$program" health --bind "$address" 2> /dev/null; do sleep 0.1; done
export SCHEMATHESIS_HOOKS=hooks
PYTHONPATH=. schemathesis --config-file schemathesis.toml run "http://$address/openapi.json" --checks all \
    --phases examples,coverage,fuzzing,stateful --max-examples "${1:-100}" --seed 1 --generation-deterministic
"$program" health --bind "$address"
