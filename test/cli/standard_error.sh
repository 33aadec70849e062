#!/bin/bash
# The standard error that gtrace claims is the error it makes. The same ray is traced 400 times, each time with other random
# numbers; the answers must scatter about their mean as widely as they say. TAP.
set -u
cd "${GRAZE_ROOT:?}/test/peer/scenes" || exit 2
number=0

# honest DESCRIPTION RAY OPTIONS... SCENE: of 400 answers, the errors made and claimed agree in their mean square to a factor
# of 1.5 in the error, at most 4 % are off by more than 3 claimed errors, and at most 1 % by more than 6. (Stopping at an error
# that is itself an estimate prefers those that came out too small; 16 replicates give Student's t with 15 degrees of freedom:
# 0.9 % and 0.002 %.) Or both are below 1e-7 of the answer, which is exact then.
honest() {
    local description=$1 ray=$2 result
    shift 2
    number=$((number + 1))
    result=$(for _ in {1..400}; do echo "$ray"; done | "${BIN:?}/gtrace" -h -w- -ove "$@" | awk '
        { value[NR] = $2; claimed[NR] = $5; sum += $2; squares += $5 * $5 }
        END {
            mean = sum / NR
            for (i = 1; i <= NR; i++) {
                d = value[i] - mean; made += d * d
                if (d < 0) d = -d
                if (d > 3 * claimed[i]) beyond3++
                if (d > 6 * claimed[i]) beyond6++
            }
            ratio = squares > 0 ? sqrt(made / squares) : -1
            exact = made < 1e-14 * mean * mean * NR && squares < 1e-14 * mean * mean * NR
            good = exact || NR == 400 && mean > 0 && ratio > 1 / 1.5 && ratio < 1.5 && beyond3 <= 16 && beyond6 <= 4
            printf "%s mean %.5g, error made %.3g, claimed %.3g; beyond 3 claimed errors %.1f %%, beyond 6 %.1f %%\n",
                (good ? "ok" : "bad"), mean, sqrt(made / NR), sqrt(squares / NR), beyond3 / NR * 100, beyond6 / NR * 100
        }')
    case $result in
    ok*) echo "ok $number - $description" ;;
    *) printf 'not ok %d - %s\n# %s\n' "$number" "$description" "$result" ;;
    esac
}

floor='-1.4 -.87 1 0 0 -1'
corner='0 2.3 0.3 1 0 0'
for stop in '--error .02' '--error .005' '--samples 256'; do
    # shellcheck disable=SC2086
    {
        honest "two lights of unlike importance, $stop" "$floor" $stop -ab 0 ring_cylinder.rad
        honest "two lights, highlight, $stop" '0 -6 2.5 -0.1 0.97 -0.18' $stop -ab 0 plastic_sphere.rad
        honest "panel light half hidden, $stop" '1.9 1.55 0 0 0 1' $stop -I -ab 0 box.rad
    }
done
for stop in '--error .02' '--samples 1024'; do
    # shellcheck disable=SC2086
    {
        honest "two bounces, $stop" "$corner" $stop -I -ab 2 box.rad
        honest "sun and sky, $stop" '1 1 .5 0 -1 0' $stop -I -ab 1 sky.rad
        honest "brushed metal in glows, $stop" '-0.2 -2.5 1.2 0.192 0.9177 -0.348' $stop brushed.rad brushed_panel.rad brushed_glows.rad
        honest "grazing plane, $stop" '0 0 .1 0.004 0.9999 -0.012' $stop grazing.rad
    }
done
echo "1..$number"
