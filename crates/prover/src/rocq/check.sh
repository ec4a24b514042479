#!/bin/sh
# Checks the theorems of this directory with Rocq (Debian: apt-get install coq libcoq-coquelicot libcoq-interval).
# Prints the files that are refused, how many are accepted, and the axioms that these rest on, which are those of the real numbers.
cd "$(dirname "$0")" || exit 2
for library in VibroAxioms VibroOperations VibroRules VibroClaims; do
    coqc -q $library.v >$library.log 2>&1 || { cat $library.log; exit 2; }
done
for file in eq_*.v; do echo "$file"; done | xargs -P "$(nproc 2>/dev/null || echo 2)" -I '{}' sh -c \
    'coqc -q "$1" >"${1%.v}.log" 2>&1 || echo "refused: $1, see ${1%.v}.log"' sh '{}' >refused.txt
cat refused.txt
all=$(ls eq_*.v | wc -l) refused=$(wc -l <refused.txt)
echo "$((all - refused)) accepted, $refused refused; axioms:"
cat eq_*.log | grep -o '^[A-Za-z][A-Za-z_]*\.[A-Za-z_.]*' | sort -u
[ "$refused" = 0 ]
