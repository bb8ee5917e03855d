"""Computes an ONNX model over a golden trace, and compares: check_onnx.py MODEL TRACE [TOLERANCE]

MODEL is what `gambol export --to onnx` writes, TRACE what `--to trace` writes for the same champion. Needs the packages
onnx, onnxruntime and numpy. Prints the greatest difference of all outputs, and fails if it is greater than the
tolerance, 1e-6.
"""

import csv
import json
import sys

import numpy
import onnx
import onnxruntime


def columns(header, name):
    """The columns name0, name1, and so on."""
    return [index for index, column in enumerate(header) if column.startswith(name) and column[len(name):].isdigit()]


def main(model_path, trace_path, tolerance="1e-6"):
    model = onnx.load(model_path)
    onnx.checker.check_model(model, full_check=True)
    metadata = {entry.key: entry.value for entry in model.metadata_props}
    with open(trace_path, newline="") as file:
        header, *rows = csv.reader(file)
    numbers = numpy.array(rows, dtype=numpy.float64).astype(numpy.float32)
    inputs, outputs = numbers[:, columns(header, "input")], numbers[:, columns(header, "output")]
    assert len(json.loads(metadata["inputs"])) == inputs.shape[1], "the metadata list the inputs"
    assert len(json.loads(metadata["outputs"])) == outputs.shape[1], "the metadata list the outputs"
    session = onnxruntime.InferenceSession(model_path, providers=["CPUExecutionProvider"])
    state = {
        value.name: numpy.zeros(value.shape, numpy.float32) for value in session.get_inputs() if value.name == "state"
    }
    greatest = 0.0
    for sensed, wanted in zip(inputs, outputs):
        found, *following = session.run(None, {"inputs": sensed[None, :], **state})
        state = dict(zip(state, following))
        greatest = max(greatest, float(numpy.abs(found[0] - wanted).max()))
    print(f"{metadata['creature']} {metadata['movement']}: {len(inputs)} steps, greatest difference {greatest:.3g}")
    return 0 if greatest <= float(tolerance) else 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
