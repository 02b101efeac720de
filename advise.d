advise: examples/tools/advise.c gvi.h examples/scenes/scenes.c \
 examples/scenes/scene.h examples/tools/effects.h \
 examples/scenes/outer_solar_system.c examples/scenes/satellite.c \
 examples/scenes/arenstorf.c examples/scenes/figure_eight.c \
 examples/scenes/double_pendulum.c examples/scenes/elastic_pendulum.c \
 examples/scenes/lagrange_top.c examples/scenes/robot_arm.c \
 examples/scenes/fput.c examples/scenes/net.c \
 examples/scenes/crossed_fields.c examples/scenes/duffing.c \
 examples/tools/advise.h examples/tools/../../tests/cost/baselines.h \
 examples/tools/../../tests/cost/problems.h /tmp/pp/mine.c
gvi.h:
examples/scenes/scenes.c:
examples/scenes/scene.h:
examples/tools/effects.h:
examples/scenes/outer_solar_system.c:
examples/scenes/satellite.c:
examples/scenes/arenstorf.c:
examples/scenes/figure_eight.c:
examples/scenes/double_pendulum.c:
examples/scenes/elastic_pendulum.c:
examples/scenes/lagrange_top.c:
examples/scenes/robot_arm.c:
examples/scenes/fput.c:
examples/scenes/net.c:
examples/scenes/crossed_fields.c:
examples/scenes/duffing.c:
examples/tools/advise.h:
examples/tools/../../tests/cost/baselines.h:
examples/tools/../../tests/cost/problems.h:
/tmp/pp/mine.c:
