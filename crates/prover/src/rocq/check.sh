#!/bin/sh
# Checks the theorems of this directory with Rocq (Debian: apt-get install coq libcoq-coquelicot libcoq-interval).
# Prints the axioms that each rests on, which are those of the real numbers alone, and at the end how many are accepted.
cd "$(dirname "$0")" || exit 2
for library in VibroAxioms VibroOperations VibroRules VibroClaims; do
    [ -f $library.vo ] || coqc -q $library.v >$library.log 2>&1 || { cat $library.log; exit 2; }
done
accepted=0 refused=0
for file in eq_*.v; do
    if coqc -q "$file" >"${file%.v}.log" 2>&1; then
        accepted=$((accepted + 1))
    else
        refused=$((refused + 1))
        echo "refused: $file, see ${file%.v}.log"
    fi
done
echo "$accepted accepted, $refused refused"
[ $refused = 0 ]
