# Scenes that tests of gpict share. To be sourced.

# A red ball before the eye at the origin, that looks along y, and a lamp.
ball_and_lamp() {
    cat <<'END'
void plastic red 0 0 5 .7 .1 .1 .05 .1
red sphere ball 0 0 4 0 5 0 1
void light white 0 0 3 9 9 9
white sphere lamp 0 0 4 2 3 2 .3
END
}

# The same in a gray ball of radius 9 around both.
closed_room() {
    ball_and_lamp
    cat <<'END'
void plastic gray 0 0 5 .5 .5 .5 0 0
gray sphere walls 0 0 4 0 5 0 9
END
}
