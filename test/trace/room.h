/* A room of 4 x 6 x 3 with an opening in the wall at y = 0. */
#ifndef TEST_TRACE_ROOM_H
#define TEST_TRACE_ROOM_H

/* Its floor, ceiling and walls but for that one, of a material. */
#define ROOM_WITHOUT_FRONT(m)                                                                                          \
    m " polygon floor 0 0 12 0 0 0 4 0 0 4 6 0 0 6 0 " m " polygon ceiling 0 0 12 0 0 3 0 6 3 4 6 3 4 0 3\n" m         \
      " polygon west 0 0 12 0 0 0 0 6 0 0 6 3 0 0 3 " m " polygon east 0 0 12 4 0 0 4 0 3 4 6 3 4 6 0\n" m             \
      " polygon north 0 0 12 0 6 0 4 6 0 4 6 3 0 6 3\n"

/* That wall: the opening is at 1 .. 3, from 1 up to `top`. */
#define ROOM_FRONT(m, top)                                                                                             \
    m " polygon south 0 0 30 0 0 0 0 0 3 4 0 3 4 0 0 0 0 0 1 0 1 3 0 1 3 0 " top " 1 0 " top " 1 0 1\n"

#endif
