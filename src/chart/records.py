"""chart.csv has a row for each run, chart.yaml all that was found."""
import csv
import io

import numpy
import yaml

from files import write_whole
from table import notes


def run_record(findings, run):
    """All that is known of a run."""
    stepping, survey = run.settings.stepping, findings.survey
    record = {"scheme": findings.scheme_text(run.settings), "elements_factor": float(run.settings.mesh),
              "elements": run.elements, "step_s": stepping.step if stepping and stepping.tolerance is None else None,
              "tolerance_m": stepping.tolerance if stepping else None, "status": run.status, "message": run.message}
    if not run.is_finished:
        return record
    error, column = findings.error(run)
    record |= {"cost_s": findings.chooser.cost(run), "solve_cpu_s": run.cost, "process_cpu_s": min(run.process_cpu),
               "repetitions": len(run.process_cpu), "steps": run.steps, "newton_iterations": run.newton,
               "error_rms": error, "error_is_bound": findings.errs_by_less(run, column),
               "error_largest": findings.largest_error(run), "worst": column}
    if survey.mesh_ladder is not None and run in survey.mesh_ladder.runs:
        record["mesh_error_rms"] = findings.share(survey.mesh_ladder, run)
    if any(run in ladder.runs for ladder in survey.ladders.values()):
        record["step_error_rms"] = findings.share(survey.step_ladder, run)
    return record


def column_records(reference):
    """How each column is judged."""
    return {name: {"scale": reference.scale[name], "known_to": reference.doubt[name], "from_s": judged.start,
                   "until_s": judged.end,
                   "orders": {ladder.kind: ladder.order(name, reference.mask[name]) for ladder in reference.ladders}}
            for name, judged in reference.judged.items()}


def plain(value):
    """Numbers of numpy as Python's, which YAML's writer knows."""
    if isinstance(value, dict):
        return {key: plain(part) for key, part in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(part) for part in value]
    return value.item() if isinstance(value, numpy.generic) else value


def write_table(findings, records):
    columns = findings.reference.columns
    keys = list(dict.fromkeys(key for _, record in records for key in record))
    file = io.StringIO()
    writer = csv.writer(file)
    writer.writerow([*keys, *(f"error_rms {name}" for name in columns)])
    for run, record in records:
        errors = findings.reference.errors(run) if run.is_finished else {}
        writer.writerow([record.get(key, "") for key in keys] + [errors.get(name, [""])[0] for name in columns])
    write_whole(findings.given.folder / "chart.csv", file.getvalue())


def left_out(findings, choice):
    """{column that a row does not cover: what it errs by with the row's settings, as far as that is known}"""
    errors = findings.reference.errors(choice.run) if choice.run else {}
    return {name: errors.get(name, [None])[0] for name in choice.left_out}


def write(findings):
    records = [(run, run_record(findings, run)) for run in findings.runner.all.values()]
    write_table(findings, records)
    choices = [{"accuracy": choice.accuracy, "error": choice.error, "worst": choice.column, "left_out": left_out(findings, choice),
                "settings": run_record(findings, choice.run) if choice.run else None} for choice in findings.choices]
    content = {"scene": str(findings.given.scene), "cpu_s": findings.runner.spent, "budget_s": findings.runner.budget,
               "orders": findings.reference.orders(), "known_to": findings.doubt,
               "predictable_until_s": findings.reference.chaos,
               "yours": run_record(findings, findings.own), "cheapest": choices, "notes": notes(findings),
               "columns": column_records(findings.reference), "runs": [record for _, record in records]}
    text = yaml.safe_dump(plain(content), sort_keys=False, allow_unicode=True, width=120)
    write_whole(findings.given.folder / "chart.yaml", text)
