# Every recipe is a `cargo xtask` verb; `just --list` shows them.

# all figures, or those named
figures *args:
    cargo xtask figures {{args}}

# recompute and compare with the committed reference
verify *args:
    cargo xtask verify {{args}}

# what is stale and why
status *args:
    cargo xtask status {{args}}

# every input of a figure
explain *args:
    cargo xtask explain {{args}}

# figures, labels, scenes, outputs
list *args:
    cargo xtask list {{args}}

# accept new sums
bless *args:
    cargo xtask bless {{args}}

# recompute the accuracy tables and compare them
accuracy *args:
    cargo xtask accuracy {{args}}

# the page: one HTML file
report *args:
    cargo xtask report {{args}}

# run your own scene
simulate *args:
    cargo xtask simulate {{args}}

# compute the stability map of your own scene
map *args:
    cargo xtask map {{args}}

# classify the runs of a plane by outcome
sweep *args:
    cargo xtask sweep {{args}}

# write trajectories for other programs
export *args:
    cargo xtask export {{args}}

# the tests
test *args:
    cargo xtask test {{args}}

# what CI runs
ci *args:
    cargo xtask ci {{args}}

# the report as PDF
paper *args:
    cargo xtask paper {{args}}

# one deterministic archive: sources, crates, tables, pictures, descriptions
bundle *args:
    cargo xtask bundle {{args}}

# the machine and the toolchain
describe *args:
    cargo xtask describe {{args}}

# what is missing and how to get it
doctor *args:
    cargo xtask doctor {{args}}

# remove what can be made again
clean *args:
    cargo xtask clean {{args}}
