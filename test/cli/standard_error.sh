#!/bin/bash
# The standard error that gtrace claims is the error it makes. The same ray is traced 400 times, each time with other random
# numbers; the answers must scatter about their mean as widely as they say. TAP.
set -u
cd "${GRAZE_ROOT:?}/test/peer/scenes" || exit 2
number=0

# honest DESCRIPTION RAY OPTIONS... SCENE: of 400 answers, at most 8 % are off by more than 1.96 claimed errors (5 % are to be),
# and at most 2 % by more than 4; and the error claimed, in its mean square, is at most TIMES (2) that made. No error is claimed
# to fall faster than as 1/samples: where what is sampled is smooth, errors do, and may be claimed several times as large. Or
# both are below 1e-7 of the answer, which is exact then.
honest() {
    local description=$1 ray=$2 result
    shift 2
    number=$((number + 1))
    result=$(for _ in {1..400}; do echo "$ray"; done | "${BIN:?}/gtrace" -h -w- -ove "$@" | awk -v times="${TIMES:-2}" '
        { value[NR] = $2; claimed[NR] = $5; sum += $2; squares += $5 * $5 }
        END {
            mean = sum / NR
            for (i = 1; i <= NR; i++) {
                d = value[i] - mean; made += d * d
                if (d < 0) d = -d
                if (d > 1.96 * claimed[i]) beyond2++
                if (d > 4 * claimed[i]) beyond4++
            }
            ratio = made > 0 ? sqrt(squares / made) : -1
            exact = made < 1e-14 * mean * mean * NR && squares < 1e-14 * mean * mean * NR
            good = exact || NR == 400 && mean > 0 && ratio > 0 && ratio < times && beyond2 <= 32 && beyond4 <= 8
            printf "%s mean %.5g, error made %.3g, claimed %.3g; beyond 1.96 claimed errors %.1f %%, beyond 4 %.1f %%\n",
                (good ? "ok" : "bad"), mean, sqrt(made / NR), sqrt(squares / NR), beyond2 / NR * 100, beyond4 / NR * 100
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
        TIMES=6 honest "two lights of unlike importance, $stop" "$floor" $stop -ab 0 ring_cylinder.rad
        honest "two lights, highlight, $stop" '0 -6 2.5 -0.1 0.97 -0.18' $stop -ab 0 plastic_sphere.rad
        honest "panel light half hidden, $stop" '1.9 1.55 0 0 0 1' $stop -I -ab 0 box.rad
    }
done
for stop in '--error .02' '--samples 1024'; do
    # shellcheck disable=SC2086
    {
        honest "two bounces, $stop" "$corner" $stop -I -ab 2 box.rad
        TIMES=3 honest "sun and sky, $stop" '1 1 .5 0 -1 0' $stop -I -ab 1 sky.rad
        honest "grazing plane, by reflection, $stop" '0 0 .1 0.004 0.9999 -0.012' $stop --strategy brdf grazing.rad
    }
done
# Small glows that reflections alone must find: at .02 some answers stop before they have (gtrace(1), STANDARD ERROR OF AN ANSWER).
honest "brushed metal in glows, by reflection, --error .005" '-0.2 -2.5 1.2 0.192 0.9177 -0.348' --error .005 --strategy brdf brushed.rad brushed_panel.rad brushed_glows.rad
echo "1..$number"
