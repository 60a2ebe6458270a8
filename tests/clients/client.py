"""Submits a case through the client generated from the OpenAPI document, and reads the answer by its types.

    python3 client.py http://127.0.0.1:8080 TOKEN cases/first-arch"""
import json, pathlib, sys
from voussoir_client import AuthenticatedClient
from voussoir_client.api.jobs import submit_job
from voussoir_client.api.results import get_results
from voussoir_client.models import AnalysisRequest, AnalysisResult, JobStatus, StatusWord

client = AuthenticatedClient(base_url=sys.argv[1], token=sys.argv[2], raise_on_unexpected_status=True)
case = pathlib.Path(sys.argv[3])
request = AnalysisRequest.from_dict(json.loads((case / "request.json").read_text()))
expected = json.loads((case / "expected.json").read_text())

job = submit_job.sync(client=client, body=request, prefer="wait=30")
assert isinstance(job, JobStatus) and job.status == StatusWord.SUCCESSFUL, job
answer = get_results.sync(job.job_id, client=client)
assert isinstance(answer, AnalysisResult) and answer.ends, answer
end = answer.ends[0]
assert end.instability, end
# The case is held against stone that does not crush.
intensity: float = end.instability.intensity

assert answer.outcome == expected["quantities"]["outcome"] and answer.unit == expected["quantities"]["unit"], answer
assert abs(intensity - expected["quantities"]["intensity"]) <= expected["tolerance"]["intensity"]["absolute"], intensity
print(f"{case.name}: {answer.outcome} at {end.intensity} {end.unit} by {end.governed_by}, uncrushed at {intensity} {end.unit}")
