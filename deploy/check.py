"""Checks the templates of this folder against the schemas of their systems.

    pip install openjd-model botocore kubernetes-validate
    python deploy/check.py
"""

import json
import pathlib
import sys

try:
    import botocore.session
    import botocore.validate
    import kubernetes_validate
    import openjd.model
    import yaml
except ImportError as missing:
    sys.exit(
        f"check.py: Python has no {missing.name}\n"
        f"  {sys.executable} -m pip install openjd-model botocore kubernetes-validate"
    )

folder = pathlib.Path(__file__).parent


def load(name):
    text = (folder / name).read_text()
    return json.loads(text) if name.endswith(".json") else list(yaml.safe_load_all(text))


for job in load("kubernetes.yaml"):
    kubernetes_validate.validate(job, "1.32", strict=True)
    print("kubernetes.yaml:", job["metadata"]["name"], "is valid")

batch = botocore.session.get_session().get_service_model("batch")
calls = {"definition": "RegisterJobDefinition", "render": "SubmitJob", "merge": "SubmitJob"}
for name, call in calls.items():
    shape = batch.operation_model(call).input_shape
    report = botocore.validate.ParamValidator().validate(load(f"aws-batch-{name}.json"), shape)
    if report.has_errors():
        raise SystemExit(f"aws-batch-{name}.json: {report.generate_report()}")
    print(f"aws-batch-{name}.json is a valid {call}")

template = openjd.model.decode_job_template(template=load("openjd.yaml")[0])
print("openjd.yaml:", ", ".join(step.name for step in template.steps), "are valid")
